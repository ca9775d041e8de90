"""The commands of the command line, one a module; a command is imported when it is called for.

Each module has a click command of its own name, and gives the exit code back.
"""

#: name on the command line -> line of help; the module has the same name
COMMANDS = {
    "batch": "Solve many DECKS; skip those that are finished.",
    "check": "Read DECK, look for mechanisms and missing loads; solve and write nothing.",
    "confirm": "Solve DECK with another program, too, and compare the answers.",
    "convert": "Write a file of another program (.cii, .xml, .pcf) as a deck.",
    "diff": "Compare two decks or two results; 0: the same, 1: they differ.",
    "export": "Write DECK as a job for another program (OpenSees, CalculiX).",
    "run": "Solve DECK; write <stem>.out and <stem>.json.",
    "show": "Print tables of a stored result (.json).",
    "study": "Solve variants of DECK on one symbolic analysis; envelope of support loads.",
    "verify": "Run the deck of a stored result again and compare; or judge its numbers.",
}
