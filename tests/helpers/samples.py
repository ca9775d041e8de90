"""The committed files of models/foreign, written from the descriptions of their formats.

`python tests/helpers/samples.py` writes them anew; tests/formats/test_samples.py compares.
"""

from pathlib import Path

import cii_jobs as cj
import input_xml as ix
import pcf_lines as pl

FOLDER = Path(__file__).resolve().parents[2] / "models" / "foreign"
XML_VERSIONS = ("7.00", "11.00", "14.00")
SIX = {"od": 168.3, "wall": 7.11}
FOUR = {"od": 114.3, "wall": 6.02}


def hot_line(version):
    """Pump 10 to header 150, with a branch 130-190: rests with friction, a gapped guide, a stop.

    10-40 flange and valve on a nozzle that moves 2 mm up; riser 70-80; 90 a hanger to be designed;
    120 a stop with 5 mm; 130 a welding tee; 145-148 an expansion joint; 160 a given hanger;
    160-170 a reducer.
    """
    c = cj.job(version, titles=("Hot oil from P-101", "  a sample of Trunnion"))
    c.coords = [(10, 0.0, 2500.0, 0.0)]
    rest = {"mu": 0.3, "cosines": cj.Y}

    def stand(node, *others):
        return [cj.slot(node, cj.RESTING, **rest), *others]

    nozzle = (10, {1: (0.5, 2.0, 0.0, 0.0, 0.0, 0.0)})
    c.add(*(10, 20), dx=100.0, RIGID=(900.0, 2), DISPLMNT=[nozzle], ALLOWBLS=0)
    c.add(20, 30, dx=400.0)
    c.add(30, 40, dx=600.0, RIGID=(5200.0, 1))
    c.add(40, 50, dx=3000.0, RESTRANT=stand(50))
    guide = cj.slot(60, cj.GUI, gap=3.0, cosines=(1, 0, 0))
    c.add(50, 60, dx=6000.0, RESTRANT=stand(60, guide))
    c.add(60, 70, dx=3000.0, BEND={"radius": 381.0, "nodes": ((-2.0202, 69), (0.0, 68))})
    c.add(70, 80, dy=4000.0, BEND={"radius": 381.0, "nodes": ((-2.0202, 79),)})
    c.add(80, 90, dx=2500.0)
    c.add(90, 100, dx=3000.0, BEND={"radius": 381.0, "nodes": ((-2.0202, 99),)})
    c.add(100, 110, dz=5000.0, RESTRANT=stand(110))
    stop = cj.slot(120, cj.LIM, gap=5.0, cosines=(1, 0, 0))
    c.add(110, 120, dz=3000.0, RESTRANT=stand(120, stop))
    c.add(120, 130, dz=2000.0, SIF=(130, 3))
    push = (140, {1: (800.0, 0.0, 0.0, 0.0, 0.0, 0.0)})
    c.add(130, 140, dz=3000.0, RESTRANT=stand(140), FORCMNT=[push])
    c.add(140, 145, dz=1000.0, RESTRANT=[cj.slot(145, cj.GUI, cosines=(1, 0, 0))])
    c.add(145, 148, dz=400.0, EXPJT=(3000.0, 20000.0, 300.0, 1e6, 300.0))
    c.add(148, 150, dz=1100.0, RESTRANT=[cj.slot(150, cj.ANC)])
    c.add(130, 160, dx=1200.0, **SIX)
    c.add(160, 170, dx=300.0, REDUCERS=(114.3, 6.02), **SIX)
    c.add(170, 180, dx=1500.0, BEND={"radius": 152.4}, **FOUR)
    c.add(180, 190, dy=-2000.0, RESTRANT=[cj.slot(190, cj.ANC)], **FOUR)
    c.hangers = [{"node": 90, "table": 1}, {"node": 160, "k": 200.0, "cold": 3500.0}]
    return c


def skid_line(version):
    """Anchor 10 to nozzle 80 with a bend, a valve, a tee, rests with friction, guide and stop."""
    none, up, across = (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
    late = version != "7.00"

    def slots(*given):
        return ix.restraints(version, *given)

    def bend(radius, middle):
        nodes = {"ANGLE1": -2.0202, "NODE1": middle}
        blank = dict.fromkeys(("ANGLE2", "NODE2", "ANGLE3", "NODE3", "NUM_MITER", "KFACTOR"))
        return ix.tag("BEND", RADIUS=radius, TYPE=None, **nodes, **blank, FITTINGTHICKNESS=None)

    def rigid(weight, kind):
        return ix.tag("RIGID", WEIGHT=weight, **({"TYPE": kind} if late else {}))

    first = {
        **{"DIAMETER": 168.300003, "WALL_THICK": 7.11, "INSUL_THICK": 50.0, "CORR_ALLOW": 1.5},
        **{"TEMP_EXP_C1": 180.0, "TEMP_EXP_C2": 60.0, "PRESSURE1": 10.0, "PRESSURE2": 4.0},
        **{"MODULUS": 203395.359375, "POISSONS": 0.292, "PIPE_DENSITY": 0.007833},
        **{"INSUL_DENSITY": 0.000136, "FLUID_DENSITY": 0.00085, "MATERIAL_NUM": 106},
    }
    rest = (None, None, 0.3, None, up, "")
    allowed = ix.tag("ALLOWABLESTRESS", PIPING_CODE=None)
    vectors = "".join(
        ix.tag("VECTOR", NUMBER=f"{n}", **dict.fromkeys(("DX", "DY", "DZ", "RX", "RY", "RZ")))
        for n in range(2, 10)
    )
    moved = ix.tag("VECTOR", NUMBER="1", DX=0.0, DY=1.5, DZ=0.0, RX=0.0, RY=0.0, RZ=0.0)
    nozzle = ix.tag("DISPLACEMENTS", moved + vectors, DISP_NUM="1", NODE_NUM=80)
    hanger = ix.tag("HANGER", NODE=60, LOAD_VAR=25.0, COLD_LOAD=None, HGR_TABLE="1")
    small = {"DIAMETER": 88.900002, "WALL_THICK": 5.49}
    rows = [
        ((10, 20, (2000.0, None, None)), allowed + slots((10, 0, *(None,) * 4, none, "")), first),
        ((20, 30, (4000.0, None, None)), slots((20, 17, *rest)) + bend(228.600006, 29), {}),
        ((30, 40, (None, None, 3000.0)), slots((40, 17, *rest)), {}),
        ((40, 50, (None, None, 700.0)), rigid(1800.0, "Valve"), {}),
        (
            (50, 55, (None, None, 2500.0)),
            slots(
                (55, 17, *rest),
                (55, 7, None, 3.0, None, None, across, ""),
                (55, 10, None, 5.0, None, None, across, ""),
            )
            + ix.tag("SIF", SIF_NUM="1", NODE=55, TYPE=3),
            {},
        ),
        ((55, 60, (None, None, 4000.0)), hanger, {}),
        ((60, 70, (None, None, 1500.0)), bend(228.600006, 69), {}),
        ((70, 80, (None, -2500.0, None)), nozzle, {}),
        ((55, 90, (1800.0, None, None)), slots((90, 0, *(None,) * 4, none, "")), small),
    ]
    elements = [
        ix.element(*place, inside, f"L-{n}" * late, version, **values)
        for n, (place, inside, values) in enumerate(rows, 1)
    ]
    counts = {"NUMBEND": 2, "NUMRIGID": 1, "NUMREST": 5, "NUMFORCMNT": 0, "NOHGRS": 0}
    return ix.document(version, *elements, **counts)


def files():
    """Give the bytes of all samples by name."""
    found = {
        f"hot_line_{version:g}.cii": hot_line(version).text().encode("cp1252")
        for version in cj.VERSIONS
    }
    found |= {
        f"skid_line_{version}.xml": skid_line(version).replace("><", ">\r\n<").encode()
        for version in XML_VERSIONS
    }
    found["plant_line.pcf"] = pl.everything().replace("\n", "\r\n").encode()
    found["pump_line.pcf"] = pl.pump_line().encode()
    found["plant_line.toml"] = pl.TABLE.encode()
    return found


if __name__ == "__main__":
    for name, data in files().items():
        (FOLDER / name).write_bytes(data)
