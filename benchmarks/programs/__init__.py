"""Programs that solve a rack, one module each."""
