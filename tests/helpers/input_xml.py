"""CAESAR II input XML written from the description of the format, for versions 7, 11 and 14."""

BLANK = -1.0101
SLOTS = {"7.00": 4, "11.00": 6, "14.00": 6}
PROPERTIES = (
    *("DIAMETER", "WALL_THICK", "INSUL_THICK", "CORR_ALLOW"),
    *(f"TEMP_EXP_C{n}" for n in range(1, 10)),
    *(f"PRESSURE{n}" for n in range(1, 10)),
    *("MODULUS", "POISSONS", "PIPE_DENSITY", "INSUL_DENSITY", "FLUID_DENSITY", "MATERIAL_NUM"),
)

UNITS = (
    *(("LENGTH", "mm.", 25.4), ("FORCE", "N.", 4.448), ("MASS-DYNAMICS", "Kg.", 0.4536)),
    *(("MOMENT-INPUT", "N.m.", 0.112985), ("MOMENT-OUTPUT", "N.m.", 0.112985)),
    *(("STRESS", "MPa", 0.006895), ("TEMP", "C", 0.5556), ("PRESSURE", "bars", 0.068946)),
    *(("EMOD", "MPa", 0.006895), ("PDENS", "kg. / cu.cm.", 0.02768)),
    *(("IDENS", "kg. / cu.cm.", 0.02768), ("FDENS", "kg. / cu.cm.", 0.02768)),
    *(("TRANS_STIFF", "N. / cm.", 1.751), ("ROTL_STIFF", "N.m. / deg", 0.112985)),
    *(("UNIF_LOAD", "N. / cm.", 1.751), ("G_LOAD", "g's", 1.0), ("WIND_LOAD", "KPa", 6.894757)),
    *(("ELEVATION", "m.", 0.0254), ("COMPOUND_LENGTH", "mm.", 25.4)),
    *(("DIAMETER", "mm.", 25.4), ("THICKNESS", "mm.", 25.4)),
)


def number(value):
    """Six decimals, as the program writes every number."""
    return f"{BLANK if value is None else value:.6f}"


def tag(name, inside="", **attributes):
    """One tag; numbers get six decimals, None is a blank."""
    words = [
        f'{key}="{value if isinstance(value, str) else number(value)}"'
        for key, value in attributes.items()
    ]
    head = " ".join([name, *words])
    return f"<{head}>{inside}</{name}>" if inside else f"<{head}/>"


def restraints(version, *given):
    """The slots of one element: (node, type, stiffness, gap, mu, cnode, cosines, tag)."""
    slots = [*given, *[(None,) * 6 + ((None,) * 3, "")] * (SLOTS[version] - len(given))]
    return "".join(
        tag(
            "RESTRAINT",
            NUM=f"{n}",
            NODE=node,
            TYPE=kind,
            STIFFNESS=stiffness,
            GAP=gap,
            FRIC_COEF=mu,
            CNODE=cnode,
            XCOSINE=cosines[0],
            YCOSINE=cosines[1],
            ZCOSINE=cosines[2],
            **({} if version == "7.00" else {"TAG": name, "GUID": ""}),
        )
        for n, (node, kind, stiffness, gap, mu, cnode, cosines, name) in enumerate(slots, 1)
    )


def element(start, end, delta=(None, None, None), inside="", name="", version="14.00", **values):
    """One PIPINGELEMENT; properties that are not given are blank, hence carried."""
    given = {key: values.get(key) for key in PROPERTIES}
    if version != "7.00":
        given |= {"NAME": name}
    axes = dict(zip(("DELTA_X", "DELTA_Y", "DELTA_Z"), delta, strict=True))
    return tag("PIPINGELEMENT", inside or " ", FROM_NODE=start, TO_NODE=end, **axes, **given)


def document(version, *elements, units=UNITS, kind="Input", **counts):
    """A whole file."""
    head = {"JOBNAME": r"C:\JOBS\LINE", "NUMELT": f"{len(elements)}"}
    head |= {key: f"{value}" for key, value in counts.items()}
    if version != "7.00":
        head |= {"NORTH_X": "0.000000", "NORTH_Y": "0.000000", "NORTH_Z": "-1.000000"}
    table = "".join(tag(n, LABEL=label, FACTOR=factor) for n, label, factor in units)
    gap = "\n" if version == "14.00" else ""
    body = gap.join([*elements, f"<UNITS>{table}</UNITS>"])
    model = tag("PIPINGMODEL", gap + body, xmlns="", **head)
    return tag("CAESARII", model, xmlns="COADE", VERSION=version, XML_TYPE=kind)


def line(version):
    """A line in steel with a bend, a valve, a branch, every support that is known.

    10 (anchor) - 20 bend - 30 rest with friction - 40 valve - 50 guide, stop; 30 - 60 branch with a
    nozzle at 60 that is held by a vector of zeros that the program leaves out.
    """
    none = (0.0, 0.0, 0.0)
    bend = tag(
        "BEND",
        RADIUS=152.399994,
        TYPE=None,
        ANGLE1=-2.0202,
        NODE1=19,
        ANGLE2=0.0,
        NODE2=18,
        ANGLE3=None,
        NODE3=None,
        NUM_MITER=None,
        FITTINGTHICKNESS=None,
        KFACTOR=None,
    )
    first = element(
        *(10, 20, (2000.0, None, None)),
        bend + restraints(version, (10, 0, None, None, None, None, none, "A-10")),
        "HEADER",
        version,
        DIAMETER=114.300003,
        WALL_THICK=6.02,
        INSUL_THICK=50.0,
        CORR_ALLOW=1.5,
        TEMP_EXP_C1=170.0,
        PRESSURE1=12.0,
        MODULUS=203395.359375,
        POISSONS=0.292,
        PIPE_DENSITY=0.007833,
        INSUL_DENSITY=0.000136,
        FLUID_DENSITY=0.0009,
        MATERIAL_NUM=106,
    )
    rest = restraints(version, (30, 17, None, 2.0, 0.3, None, (0.0, 1.0, 0.0), "S-30"))
    second = element(20, 30, (None, None, 3000.0), rest, version=version)
    kind = {} if version == "7.00" else {"TYPE": "Valve"}
    valve = tag("RIGID", WEIGHT=320.0, **kind)
    third = element(30, 40, (None, None, 400.0), valve, version=version, MATERIAL_NUM=106)
    stops = restraints(
        version,
        (50, 7, None, None, 0.1, None, (1.0, 0.0, 0.0), ""),
        (50, 10, 8756.0, 5.0, None, None, (1.0, 0.0, 0.0), ""),
        (50, 2, None, None, None, None, (0.0, 1.0, 0.0), ""),
    )
    fourth = element(40, 50, (None, None, 2500.0), stops, version=version, INSUL_THICK=0.0)
    vectors = "".join(
        tag("VECTOR", NUMBER=f"{n}", DX=None, DY=None, DZ=None, RX=None, RY=None, RZ=None)
        for n in range(2, 10)
    )
    held = tag("DISPLACEMENTS", vectors, DISP_NUM="1", NODE_NUM=60)
    held += tag("DISPLACEMENTS", vectors, DISP_NUM="2", NODE_NUM=None)
    push = tag("VECTOR", NUMBER="1", FX=1000.0, FY=None, FZ=None, MX=None, MY=50.0, MZ=None)
    push = tag("FORCESMOMENTS", push, FORCMNT_NUM="1", NODE_NUM=30)
    fifth = element(30, 60, (1500.0, None, None), held + push, version=version)
    return document(
        version,
        *(first, second, third, fourth, fifth),
        NUMBEND=1,
        NUMRIGID=1,
        NUMREST=3,
        NUMFORCMNT=1,
        NOHGRS=0,
    )


def crowded(version):
    """A line with every child that an element can have, bodies with offsets, a CNODE, a nozzle."""
    none = (0.0, 0.0, 0.0)
    anchor = restraints(version, (10, 0, None, None, None, None, none, "A-10"))
    joint = {"AXIAL_STIF": 100.0, "TRANS_STIF": 50.0, "BEND_STIF": None, "TORS_STIF": None}
    bellows = tag("EXPANSIONJOINT", BEL_DIA=120.0, **joint)
    size = {"DIAMETER": 114.300003, "WALL_THICK": 6.02, "TEMP_EXP_C1": 170.0, "PRESSURE1": 12.0}
    steel = {"MODULUS": 203395.359375, "POISSONS": 0.292, "PIPE_DENSITY": 0.007833}
    cover = {"INSUL_THICK": 50.0, "FLUID_DENSITY": 0.001, "MATERIAL_NUM": 106.0}
    arms = {f"{end}{axis}": None for end in ("FROM", "TO") for axis in "XYZ"}
    offset = tag("OFFSET", **{**arms, "FROMX": 100.0, "TOZ": 50.0})
    cone = tag("REDUCER", DIAMETERS2=88.9, THICKNESS2=5.49, ALPHA=None, R1=None, R2=None)
    small = {"DIAMETER": 88.900002, "WALL_THICK": 5.49}
    load = tag("VECTOR", VECTOR_NUM="1", UX=0.0, UY=-1.0, UZ=0.0)
    asked = {"RIGID_SUP": 3.0, "MAX_TRAVEL": 9999.990234, "FREEANCHOR1": 10.0, "DOFTYPE1": "1"}
    hanger = tag("HANGER", NODE=60, COLD_LOAD=None, NUM_HGR=2.0, HGR_TABLE="7", **asked)
    stops = restraints(
        version,
        (60, 17, None, 2.0, 0.3, 70, (0.0, 1.0, 0.0), "S-1"),
        (60, 7, None, 3.0, None, None, (1.0, 0.0, 0.0), ""),
        (60, 4, 100.0, 1.0, None, None, (1.0, 0.0, 0.0), ""),
    )
    flange = tag("RIGID", WEIGHT=300.0, TYPE="Flange Pair")
    vector = {"DX": 1.0, **dict.fromkeys(("DY", "DZ", "RX", "RY", "RZ"))}
    moved = tag("DISPLACEMENTS", tag("VECTOR", NUMBER="2", **vector), DISP_NUM="1", NODE_NUM=80)
    checks = tag("SIF", SIF_NUM="1", NODE=80, TYPE=3) + tag("ALLOWABLESTRESS", PIPING_CODE=0.0)
    nozzle = tag("WRC297_NOZZLE", NOZZLE_NODE=80, VESSEL_NODE=75)
    bend = tag("BEND", RADIUS=133.350006, TYPE=1.0, ANGLE1=-2.0202, NODE1=49, NUM_MITER=None)
    rows = (
        (10, 20, (1000.0, None, None), anchor + bellows, size | steel | cover),
        (20, 30, (None, None, None), bellows, {}),
        (30, 40, (None, 1000.0, None), offset + cone, {}),
        (40, 50, (None, 1000.0, None), bend + tag("WIND", WSHAP_WDRC=0.6), small),
        (50, 60, (1000.0, None, None), flange + stops + hanger + tag("UNIFORMLOAD", load), {}),
        (70, 80, (1000.0, None, None), moved + checks + nozzle, {}),
        (60, 90, (None, None, 900.0), "", {"TEMP_EXP_C1": 0.002}),
    )
    elements = [
        element(start, end, delta, inside, version=version, **values)
        for start, end, delta, inside, values in rows
    ]
    return document(version, *elements, NUMBEND=1, NUMRIGID=1, NUMEXPJNT=2, NUMREST=2)
