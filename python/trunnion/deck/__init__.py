"""The only reader of decks: text in, records out, and the words shared with the Python API."""
