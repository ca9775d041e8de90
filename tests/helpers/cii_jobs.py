"""Jobs that the tests of neutral files share."""

from cii import Cii

VERSIONS = (7.01, 11.0, 15.01)
PIPE = {
    **{"od": 273.05, "wall": 9.271, "insulation": 75.0, "corrosion": 1.5, "t1": 170.0, "p1": 12.0},
    **{"e": 203400.0, "nu": 0.292, "density": 0.00783344, "insulation_density": 0.00014},
    **{"fluid": 0.00085, "t2": 90.0, "p2": 6.0, "hydro": 18.0},
}
Y = (0.0, 1.0, 0.0)
ANC, RESTING, GUI, LIM = 1, 14, 8, 9


def job(version=11.0, **keys):
    made = Cii(version=version, **keys)
    made.defaults = dict(PIPE)
    return made


def slot(node, code, **keys):
    return {"node": node, "type": code, **keys}


def everything(version):
    """One file with every feature that a model has; records are stored backwards."""
    c = job(version, titles=("Hot oil header", "  unit 5"), unlike=("RESTRANT", "BEND"))
    c.coords = [(10, 0.0, 2500.0, 0.0)]
    tag = {"tag": "PS-20"} if version > 8 else {}
    c.add(
        *(10, 20),
        dx=6000.0,
        name="LINE-1",
        NODENAME=("PUMP", ""),
        RESTRANT=[slot(10, ANC), slot(20, RESTING, mu=0.3, cosines=Y, **tag)],
        FORCMNT=[(20, {1: (0.0, -500.0, 0.0, 0.0, 0.0, 30.0)})],
    )
    c.add(20, 30, dx=6000.0, BEND={"radius": 381.0, "nodes": ((-2.0202, 29), (0.0, 28))})
    guided = [slot(40, GUI, gap=3.0, mu=0.2, cosines=(1, 0, 0)), slot(40, LIM, gap=10.0, k=2e4)]
    c.add(
        *(30, 40),
        dz=4000.0,
        RESTRANT=[*guided, slot(29, RESTING, k=500.0, cosines=Y)],
    )
    c.add(40, 50, dz=500.0, RIGID=(2100.0, 1), od=273.05)
    c.add(50, 60, dz=1500.0, BEND={"radius": 381.0, "nodes": ((45.0, 59),), "flanges": 1})
    moved = {1: (1.5, 3.0, None, None, None, 0.5), 2: (0.0, 1.0, None, None, None, None)}
    c.add(60, 70, dy=-3000.0, DISPLMNT=[(70, moved), (71, {1: (0.0,) * 6})])
    c.add(40, 71, dx=2500.0, material=163, od=114.3, wall=6.02, insulation=0.0, e=195100.0)
    c.hangers = [{"node": 50, "k": 100.0, "cold": 8000.0, **({"tag": "SH-1"} if tag else {})}]
    return c


def crowded(version):
    """One file with every array of the format, and bodies beside bends, offsets and branches."""
    c = job(version, bourdon=1, titles=("Every array",))
    c.coords = [(10, 0.0, 2500.0, 0.0), (200, 9000.0, 0.0, 0.0)]
    loads = [0.0] * 36
    loads[:8] = (0.2, 0.0, 0.0, 1.0, 0.0, -3.0, 0.0, 0.0)
    c.add(
        *(10, 20),
        dx=3000.0,
        RESTRANT=[slot(10, ANC)],
        UNIFORM=loads,
        WIND=(0.0, 0.6, 0.0, 0.0, 0.0, 0.0),
        ALLOWBLS=0,
    )
    bend = {
        "radius": 381.0,
        "nodes": ((-2.0202, 29), (0.0, 28)),
        "flanges": 2,
        "fitting": 12.7,
        "miters": 3,
    }
    c.add(20, 30, dx=3000.0, BEND=bend, OFFSETS=(0.0, 150.0, 0.0, 0.0, 0.0, 0.0))
    c.add(30, 40, dz=1500.0, RIGID=(2100.0, 1), NODENAME=("", "VALVE"))
    c.add(40, 50, dz=800.0, REDUCERS=(219.1, 8.18, 10.0), OFFSETS=(0.0, 0.0, 0.0, 0.0, 80.0, 0.0))
    small = {"od": 219.1, "wall": 8.18}
    joint = {"EXPJT": (2e3, 1e3, 0.0, 0.0, 250.0)}
    c.add(50, 60, dz=400.0, **small, **joint, FLANGES=0, EQUIPMNT=0)
    c.add(60, 70, **small, EXPJT=(2e3, 0.0, 50.0, 0.0, 0.0))
    gapped = slot(80, RESTING, cosines=Y, cnode=180, gap=2.0, mu=0.3)
    column = slot(180, 3, k=1e4, cosines=Y)
    c.add(70, 80, dz=2000.0, **small, RESTRANT=[gapped, column], SIF=(80, 3), material=18)
    c.add(80, 90, dz=2000.0, **small, BEND={"radius": 305.0, "nodes": ((30.0, 88),)})
    stops = [
        slot(88, RESTING, cosines=Y),
        slot(90, 25, gap=3.0, cosines=(1, 0, 0)),
        slot(90, 11, cosines=Y),
        slot(89, GUI),
    ]
    c.add(90, 100, dy=-1500.0, **small, RESTRANT=stops, t1=0.002, t2=0.0)
    moved = {1: (1.5, -3.0, None, None, None, 0.5), 9: (0.0, 1.0, None, None, None, None)}
    c.add(100, 110, dy=-1000.0, **small, DISPLMNT=[(110, moved), (180, {1: (0.0,) * 6})])
    pushed = {2: (0.0, -500.0, 0.0, 0.0, 30.0, 0.0)}
    c.add(80, 120, dx=1500.0, od=114.3, wall=6.02, FORCMNT=[(120, pushed)])
    c.add(120, 130, od=114.3, wall=6.02)
    c.add(200, 210, dx=1000.0, RESTRANT=[slot(200, ANC), slot(210, ANC, cnode=130)])
    c.nozzles = [(120, 190)]
    c.hangers = [
        {"node": 20, "free": (10, 1, 0, 0), "number": 2},
        {"node": 70, "k": 100.0, "cold": 8000.0, "cnode": 180},
    ]
    return c
