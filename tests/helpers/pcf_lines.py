"""Piping component files written from the description of the format: docs/pcf.md."""

HEADER = """\
ISOGEN-FILES ISOGEN.FLS
UNITS-BORE MM
UNITS-CO-ORDS MM
UNITS-WEIGHT KGS
UNITS-BOLT-DIA MM
UNITS-BOLT-LENGTH MM
PIPELINE-REFERENCE LINE-A
    PROJECT-IDENTIFIER P1
    PIPING-SPEC CS1
"""


def point(name, xyz, bore=None, end=""):
    """One point record; coordinates in mm."""
    words = [f"{x:.4f}" for x in xyz] + ([] if bore is None else [f"{bore:.4f}"]) + [end]
    return f"    {name} {' '.join(words)}".rstrip()


def block(keyword, *ends, centre=None, branch=None, bore=100.0, branch_bore=80.0, **attributes):
    """One component; `ends` are points, or pairs of a point and its bore."""
    lines = [keyword]
    for end in ends:
        xyz, own = end if len(end) == 2 else (end, bore)
        lines.append(point("END-POINT", xyz, own))
    if centre is not None:
        lines.append(point("CENTRE-POINT", centre, bore))
    if branch is not None:
        lines.append(point("BRANCH1-POINT", branch, branch_bore))
    for name, value in attributes.items():
        lines.append(f"    {name.replace('_', '-')} {value}")
    return "\n".join(lines) + "\n"


def pipe(a, b, bore=100.0, **attributes):
    """A straight pipe."""
    return block("PIPE", a, b, bore=bore, **attributes)


def support(xyz, skey=None, direction=None, name=None):
    """A support record."""
    lines = ["SUPPORT", point("CO-ORDS", xyz, 0.0)]
    lines += [f"    SKEY {skey}"] if skey else []
    lines += [f"    SUPPORT-DIRECTION {direction}"] if direction else []
    lines += [f"    <SUPPORT_NAME> {name}"] if name else []
    return "\n".join(lines) + "\n"


def everything():
    """A line with every component, along E at U = 1000, one branch of each kind.

    FLANGE 0-60, PIPE to 2848, ELBOW (R 152.4) into N, PIPE, TEE, PIPE with an OLET, a support,
    REDUCER, PIPE, INSTRUMENT, COUPLING, UNION, VALVE-ANGLE, PIPE, CAP; the branch of the tee has
    FLANGE, GASKET, VALVE, FLANGE-BLIND; a stub ends on the surface of a pipe.
    """
    x, z = 3000.0, 1000.0
    return HEADER + "".join(
        (
            "END-CONNECTION-EQUIPMENT\n    CO-ORDS 0.0 0.0 1000.0\n"
            "    CONNECTION-REFERENCE P-101/N1\n",
            block("FLANGE", (0, 0, z), (60, 0, z), SKEY="FLWN", WEIGHT="7.0"),
            pipe((60, 0, z), (2847.6, 0, z), ITEM_CODE="P100"),
            block(
                "ELBOW", (2847.6, 0, z), (x, 152.4, z), centre=(x, 0, z), SKEY="ELBW", ANGLE="9000"
            ),
            pipe((x, 152.4, z), (x, 1895, z)),
            block("TEE", (x, 1895, z), (x, 2105, z), centre=(x, 2000, z), branch=(3098, 2000, z)),
            block("WELD", (x, 1895, z), (x, 1895, z), SKEY="BW"),
            pipe((x, 2105, z), (x, 5000, z)),
            block(
                "OLET", centre=(x, 3500, z), branch=(x, 3500, 1110), branch_bore=25.0, SKEY="OLWL"
            ),
            pipe((x, 3500, 1110), (x, 3500, 1400), 25.0),
            block("REDUCER-CONCENTRIC", ((x, 5000, z), 100.0), ((x, 5102, z), 80.0), SKEY="RCBW"),
            pipe((x, 5102, z), (x, 7000, z), 80.0),
            block("INSTRUMENT", (x, 7000, z), (x, 7200, z), bore=80.0, WEIGHT="12"),
            block("COUPLING", (x, 7200, z), (x, 7260, z), bore=80.0),
            block("UNION", (x, 7260, z), (x, 7320, z), bore=80.0, WEIGHT="1.5"),
            block(
                "VALVE-ANGLE",
                *((x, 7320, z), (3150, 7470, z)),
                centre=(x, 7470, z),
                bore=80.0,
                SKEY="AVBW",
                WEIGHT="40",
            ),
            pipe((3150, 7470, z), (3800, 7470, z), 80.0),
            block("CAP", (3800, 7470, z), (3851, 7470, z), bore=80.0, SKEY="KABW"),
            pipe((3098, 2000, z), (4000, 2000, z), 80.0),
            block("FLANGE", (4000, 2000, z), (4050, 2000, z), bore=80.0, SKEY="FLWN", WEIGHT="5.5"),
            block("GASKET", (4050, 2000, z), (4053, 2000, z), bore=80.0),
            block(
                "VALVE",
                *((4053, 2000, z), (4336, 2000, z)),
                centre=(4194.5, 2000, z),
                bore=80.0,
                WEIGHT="32",
            ),
            "BOLT\n    CO-ORDS 4050.0 2000.0 1000.0\n",
            block("FLANGE-BLIND", (4336, 2000, z), (4360, 2000, z), bore=80.0, WEIGHT="4.5"),
            pipe((1000, 500, z), (1000, 57, z), 25.0),
            support((1500, 0, z), "SKID", "DOWN"),
            support((x, 4500, 942), "SKID", "DOWN", "PS-01"),
            support((x, 4500, z), "GUID", "EAST"),
            support((x, 4500, z), "GUID", "WEST"),
            support((x, 4500, z), "GUID", "WEST"),
            support((x, 6000, z), None, None, "VAR-SHOE-7"),
            "MESSAGE-SQUARE\n    CO-ORDS 1 2 3\n    TEXT PIPE, LENGTH=2000MM\n",
            "MESSAGE-CIRCLE\n    CO-ORDS 0.0 0.0 1000.0\n    TEXT 100\n",
            "MATERIALS\nITEM-CODE P100\n    DESCRIPTION Pipe 114.3x6.02mm\n",
        )
    )


def pump_line():
    """A suction line to a pump: what `everything` has not, with bores in inches.

    6 in PIPE along E at U = 1500, BEND of 45 degrees (R 762), PIPE, BEND back, PIPE on two rests,
    REDUCER-ECCENTRIC flat on top to 4 in, PIPE, FLANGE on the pump; a description is continued.
    """
    z, tangent = 1500.0, 762.0 * (2.0**0.5 - 1.0)
    d = tangent / 2.0**0.5  # of a tangent along both axes
    x = 2000.0 + tangent
    far = (x + d + 1000.0, d + 1000.0)  # start of the second bend
    y = far[1] + d
    end = far[0] + d + tangent  # of the second bend
    top = z + (168.3 - 114.3) / 2.0
    return HEADER.replace("UNITS-BORE MM", "UNITS-BORE INCH") + "".join(
        (
            pipe((0, 0, z), (2000, 0, z), 6.0, ITEM_CODE="P6"),
            block("BEND", (2000, 0, z), (x + d, d, z), centre=(x, 0, z), bore=6.0, SKEY="BEBW"),
            pipe((x + d, d, z), (*far, z), 6.0),
            block(
                "BEND",
                *((*far, z), (end, y, z)),
                centre=(far[0] + d, y, z),
                bore=6.0,
                BEND_RADIUS="762.0",
            ),
            pipe((end, y, z), (end + 4000, y, z), 6.0),
            block(
                "REDUCER-ECCENTRIC",
                *(((end + 4000, y, z), 6.0), ((end + 4140, y, top), 4.0)),
                SKEY="REBW",
                FLAT_DIRECTION="UP",
            ),
            pipe((end + 4140, y, top), (end + 4700, y, top), 4.0),
            block("FLANGE", (end + 4700, y, top), (end + 4776, y, top), bore=4.0, WEIGHT="7.3"),
            f"END-CONNECTION-EQUIPMENT\n{point('CO-ORDS', (end + 4776, y, top))}\n"
            "    CONNECTION-REFERENCE P-102/SUCTION\n",
            support((1500, 0, z), "SKID", "DOWN"),
            support((end + 500, y, z), "SKID", "DOWN", "PS-11"),
            support((end + 3500, y, z), "SKID", "DOWN", "PS-12"),
            support((end + 3500, y, z), "GUID", "NORTH"),
            "MATERIALS\nITEM-CODE P6\n    DESCRIPTION Pipe seamless, plain ends, hot finished,\n"
            "    CONTINUATION 168.3x7.11mm\n",
        )
    )


TABLE = """\
mu = 0.3
[defaults]
SCH = "40"
MATERIAL = "A106-B"
T1 = "150C"
P1 = "10bar"
FLUID = 800
[supports]
"VAR-SHOE*" = "+Z GUIDE GAP=3mm"
"""
