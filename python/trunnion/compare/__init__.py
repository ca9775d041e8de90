"""Stored results and decks beside each other: what differs, and whether numbers still hold."""
