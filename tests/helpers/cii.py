"""Write neutral files from a description: the fixed formats of versions 7, 11 and 15.

`Cii` holds elements (dictionaries of the 53 reals by name, and what hangs on them) and writes the
sections as the vendor's user guide and the digest of real files describe them: reals (2X,6G13.6),
in version 15 (2X,1P6E13.6), integers (2X,6I13), strings (7X,I5,1X,A), CRLF.
"""

from dataclasses import dataclass, field

# names of the reals of an element, in the order of the file (1 to 53)
REALS = (
    *("start", "end", "dx", "dy", "dz", "od", "wall", "insulation", "corrosion"),
    *(f"t{n}" for n in range(1, 10)),
    *(f"p{n}" for n in range(1, 10)),
    *("e", "nu", "density", "insulation_density", "fluid", "minus", "plus", "seam", "hydro"),
    *(f"hot{n}" for n in range(1, 10)),
    *("weld", "angle1", "angle2", "cladding", "cladding_density", "cover", "lining"),
    "lining_density",
)
POINTERS = (
    *("BEND", "RIGID", "EXPJT", "RESTRANT", "DISPLMNT", "FORCMNT", "UNIFORM", "WIND"),
    *("OFFSETS", "ALLOWBLS", "SIF&TEES", "NODENAME", "REDUCERS", "FLANGES", "EQUIPMNT"),
)
# name, ON/OFF, the constants 1 to 22, and their labels
METRIC = (
    *(25.4, 4.448, 0.4536, 0.113, 0.113, 0.006895, 0.5556, -17.7778, 0.06895, 0.006895),
    *(0.02768, 0.02768, 0.02768, 1.7512, 0.113, 1.7512, 1.0, 0.06895, 25.4, 25.4, 25.4, 25.4),
)
METRIC_LABELS = (
    *("METRIC", "ON", "mm.", "N.", "Kg.", "N.m.", "N.m.", "MPa", "C", "C", "bars", "MPa"),
    *("kg./cu.cm.", "kg./cu.cm.", "kg./cu.cm.", "N./cm.", "N.m./deg", "N./cm.", "g's"),
    *("bars", "mm.", "mm.", "mm.", "mm."),
)
ENGLISH = (
    *(1.0, 1.0, 1.0, 1.0, 0.08333, 1.0, 1.0, 0.0, 1.0, 1.0),
    *(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.08333, 0.08333, 1.0, 1.0),
)
ENGLISH_LABELS = (
    *("ENGLISH", "ON", "in.", "lb.", "lbm.", "in.lb.", "ft.lb.", "lb./sq.in.", "F", "F"),
    *("lb./sq.in.", "lb./sq.in.", "lb./cu.in.", "lb./cu.in.", "lb./cu.in.", "lb./in."),
    *("in.lb./deg", "lb./in.", "g's", "lb./sq.in.", "ft.", "ft.", "in.", "in."),
)


@dataclass
class Cii:
    """One job; `elements` are dictionaries, see `add`."""

    version: float = 11.0
    titles: tuple[str, ...] = ("Sample line",)
    constants: tuple[float, ...] = METRIC
    labels: tuple[str, ...] = METRIC_LABELS
    elements: list[dict] = field(default_factory=list)
    arrays: dict[str, list] = field(default_factory=lambda: {name: [] for name in POINTERS})
    hangers: list[dict] = field(default_factory=list)
    nozzles: list[tuple[int, int]] = field(default_factory=list)
    coords: list[tuple] = field(default_factory=list)
    z_up: bool = False
    ambient: float = 21.1142
    defaults: dict = field(default_factory=dict)
    bourdon: int = 0  # 0 none, 1 translation, 2 translation and rotation
    bowing: float = 0.0  # thermal bowing
    stiffening: int = 0  # stress stiffening
    unlike: tuple[str, ...] = ()  # arrays whose records are stored backwards

    def add(self, start, end, *, material=106, name="", like=True, **values):
        """Add an element; arrays by the name of their section: RIGID=(..), RESTRANT=[{..}, ..]."""
        record = {"angle1": 9999.99, "angle2": 9999.99}
        if like:
            record |= self.defaults
        record |= {k: v for k, v in values.items() if k in REALS}
        record |= {"start": start, "end": end, "material": material, "name": name}
        record["pointers"] = {}
        for section, data in values.items():
            if section in REALS:
                continue
            section = {"SIF": "SIF&TEES"}.get(section, section)
            self.arrays[section].append(data)
            record["pointers"][section] = len(self.arrays[section])
        self.elements.append(record)

    # fields

    def real(self, x):
        """Write one field of 13 columns."""
        if self.version >= 15:
            return f"{x:13.6E}"
        if x == 0.0:
            return f"{'0.000000':>11}  "[-13:].rjust(13)
        if 0.1 <= abs(x) < 1e6:
            whole = len(str(int(abs(x)))) if abs(x) >= 1 else 0
            text = f"{x:.{6 - whole}f}" if whole < 6 else f"{x:.0f}."
            return f"{text:>9}    "
        mantissa, exponent = f"{x:.5E}".split("E")
        sign = "-" if x < 0 else ""
        digits = mantissa.lstrip("-").replace(".", "")
        return f"{sign}0.{digits}E{int(exponent) + 1:+03d}".rjust(13)

    def reals(self, values):
        """Write lines of six."""
        values = list(values)
        rows = [values[i : i + 6] for i in range(0, len(values), 6)] or [[]]
        return ["  " + "".join(map(self.real, row)) for row in rows]

    @staticmethod
    def integers(values, each=6):
        """Write lines of six integers."""
        values = list(values)
        rows = [values[i : i + each] for i in range(0, len(values), each)]
        return ["  " + "".join(f"{int(x):13d}" for x in row) for row in rows]

    @staticmethod
    def string(text):
        """Write a string."""
        return f"       {len(text):5d} {text}"

    # sections

    def text(self):
        """Give the whole file."""
        parts = [
            ("VERSION", self.version_lines()),
            ("CONTROL", self.control_lines()),
            ("ELEMENTS", [x for e in self.elements for x in self.element_lines(e)]),
            ("AUX_DATA", []),
        ]
        writers = {
            "NODENAME": self.node_name,
            "BEND": self.bend,
            "RIGID": lambda r: self.reals(r if self.new else r[:1]),
            "EXPJT": self.reals,
            "RESTRANT": self.restraints,
            "DISPLMNT": lambda r: self.sets(r, 9999.99),
            "FORCMNT": lambda r: self.sets(r, 0.0),
            "UNIFORM": self.reals,
            "WIND": self.reals,
            "OFFSETS": self.reals,
            "ALLOWBLS": self.allowables,
            "SIF&TEES": self.sif,
            "REDUCERS": self.reducer,
            "FLANGES": lambda r: self.blank(12),
            "EQUIPMNT": lambda r: self.blank(6),
        }
        for name, write in writers.items():
            if name == "NODENAME" and not self.arrays[name]:
                continue
            records = self.arrays[name]
            if name in self.unlike:
                records = records[::-1]
            parts.append((name, [x for record in records for x in write(record)]))
        parts.append(("MISCEL_1", self.misc_lines()))
        parts.append(("UNITS", self.reals(self.constants) + [f"  {x}" for x in self.labels]))
        coords = self.integers([len(self.coords)]) + [
            f"  {int(n):13d}" + "".join(f"{x:13.3f}" for x in xyz) for n, *xyz in self.coords
        ]
        parts.append(("COORDS", coords))
        lines = [x for name, rows in parts for x in (f"#$ {name:<8}", *rows)]
        return "\r\n".join(lines) + "\r\n"

    @property
    def new(self):
        """Tell whether this is the layout of 11.0 and later."""
        return self.version >= 8

    def version_lines(self):
        first = f"  {5.0:13.6f}{self.version:13.6f}" + (f"{1252:8d}" if self.new else "")
        titles = [*self.titles, *([""] * 60)][:60]
        return [first, *(f"  {x:<75}" for x in titles)]

    def control_lines(self):
        n = {name: len(records) for name, records in self.arrays.items()}
        values = [
            *(len(self.elements), len(self.nozzles), len(self.hangers), n["NODENAME"]),
            *(n["REDUCERS"], n["FLANGES"], n["BEND"], n["RIGID"], n["EXPJT"], n["RESTRANT"]),
            *(n["DISPLMNT"], n["FORCMNT"], n["UNIFORM"], n["WIND"], n["OFFSETS"], n["ALLOWBLS"]),
            *(n["SIF&TEES"], int(self.z_up), n["EQUIPMNT"]),
        ]
        return self.integers(values)

    def element_lines(self, e):
        lines = self.reals(e.get(name, 0.0) for name in REALS)
        if self.new:
            lines += [self.string(e["name"]), self.string(""), "             -1           -1"]
        pointers = []
        for name in POINTERS:
            p = e["pointers"].get(name, 0)
            if p and name in self.unlike:
                p = len(self.arrays[name]) + 1 - p
            pointers.append(p)
        return lines + self.integers(pointers)

    @staticmethod
    def node_name(names):
        return [f"  {names[0]:<25} {names[1]:<25}"]

    def bend(self, b):
        """radius, (angle, node) ..., and flanges, miters, fitting, k by name."""
        nodes = [x for pair in b.get("nodes", ()) for x in pair]
        nodes += [0.0] * (6 - len(nodes))
        values = [b["radius"], b.get("flanges", 0), *nodes, b.get("miters", 0)]
        values += [b.get("fitting", 0.0), 0.0, b.get("k", 0.0), 0.0, 0.0]
        return self.reals(values if self.new else values[:13])

    def restraints(self, slots):
        lines = []
        for k in range(6 if self.new else 4):
            s = slots[k] if k < len(slots) else {}
            stiffness = s.get("k", self.constants[13] * 1e12 if s else 0.0)
            cosines = s.get("cosines", (0.0, 0.0, 0.0))
            names = ("node", "type")
            values = [*(s.get(x, 0) for x in names), stiffness]
            values += [s.get("gap", 0.0), s.get("mu", 0.0), s.get("cnode", 0)]
            lines += self.reals(values) + self.reals(cosines)
            if self.new:
                lines += [self.string(s.get("tag", "")), self.string("")]
        return lines

    def sets(self, slots, blank):
        """Up to two of (node, {set: six values})."""
        lines = []
        for k in range(2):
            node, sets = slots[k] if k < len(slots) else (0, {})
            lines += self.reals([node])
            for n in range(1, 10):
                row = sets.get(n, (None,) * 6)
                lines += self.reals(blank if x is None else x for x in row)
        return lines

    def reducer(self, r):
        values = [*r, 0.0, 0.0, 0.0, 0.0, 0.0][:5]
        return self.reals(values) + (self.reals([0.0] * 5) if self.version >= 14 else [])

    def blank(self, n):
        """Write records that no model takes anything from."""
        return self.reals([1.0] * 6) * n

    def allowables(self, code):
        """The number of the piping code is the 12th value."""
        lines = self.blank(28 if self.version >= 14 else 26)
        return [lines[0], *self.reals([1.0] * 5 + [code or 0]), *lines[2:]]

    def sif(self, r):
        """Node and type of an intersection; None: a record of no meaning."""
        each = 7 if self.version >= 14 else 5
        node, kind = r or (0, 0)
        return [*self.reals([node, kind, 0, 0, 0, 0]), *self.reals([0.0] * 6) * (2 * each - 1)]

    def misc_lines(self):
        lines = self.reals(e["material"] for e in self.elements)
        for node, vessel in self.nozzles:
            lines += [*self.reals([node, vessel, 0, 0, 0, 0]), *self.reals([0.0] * 6)]
            lines += [*self.reals([0.0] * 4), *self.reals([0.0] * 4)]
        if self.hangers:
            lines += self.hanger_lines()
        # print forces, print alphas, Bourdon, branch errors, bowing, liberal allowables
        options = "".join(f"{x:13d}" for x in (0, 0, self.bourdon, 2))
        lines.append(f"  {options}{self.bowing:13.4f}{1:13d}")
        ambient = self.real(self.ambient) + self.real(12.0)
        lines.append(f"  {0:13d}{self.stiffening:13d}{ambient}{0:13d}{0:13d}")
        lines.append("  " + f"{0:13d}" * 4 + f"{0.25:13.4f}{3:13d}")
        if self.new:
            lines.append(f"  {0:13d}" + (f"{0:13d}" if self.version >= 14 else ""))
        return lines

    def hanger_lines(self):
        h = self.hangers
        lines = [f"  {1:13d}" + "".join(map(self.real, (25.0, 0.0, 0.0, 0.0, 0.0)))]
        lines += self.integers([1, 0, 3, 0, 0])
        lines += self.integers(x["node"] for x in h)
        for x in h:
            values = [x.get("k", 0.0), 25.0, 0.0, x.get("space", 0.0), x.get("cold", 0.0)]
            values += [x.get("hot", 0.0), x.get("user", 0.0), 9999.99, 0.0, 0.0]
            values += [x.get("constant", 0.0)]
            lines += self.reals(values if self.new else values[:10])
            if self.new:
                lines += [self.string(x.get("tag", "")), self.string("")]
        for x in h:
            one, code, other, more = x.get("free", (0, 0, 0, 0))
            lines += self.integers([one, other, code, more])
        lines += self.integers(x.get("number", 1) for x in h)
        lines += self.integers(x.get("table", 0) for x in h)
        lines += self.integers(0 for _ in h)
        return lines + self.integers(x.get("cnode", 0) for x in h)
