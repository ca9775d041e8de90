"""Cases: their order, the run over all of them, locked cases and cycles."""
