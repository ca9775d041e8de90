"""Many decks and many variants: processes, records of what is done, studies."""
