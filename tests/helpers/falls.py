"""A deck whose only case fails: its pipe slides away, no friction can hold it."""

FALLS = """\
MATERIAL STEEL E=203e9
SECTION P OD=0.1 WALL=0.01
PIPE 10 20 DX=1
SUPPORT 10 +Y MU=0.1
SUPPORT 20 +Y MU=0.1 X RX RY RZ
FORCE 10 F1 FX=1 FY=-1 FZ=1000
CASE PUSH = F1
"""
