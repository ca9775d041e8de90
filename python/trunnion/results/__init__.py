"""Results: gathered by card and label, combined, between nodes, as stresses and tables."""
