"""The solver: from a numbered system and its loads to certified numbers."""
