"""Tables of the trade: materials, pipe sizes, and names that are nearly right."""
