"""Material numbers of the program's data base: names, constants at 70 F, a grade for expansion.

Numbers, names and constants (modulus, Poisson's ratio, density, expansion at 70 F of the code
"generic") as a user's printout of the data base has them, transcribed in the public repository
Conduit (MaterialLibrary.cs).  102, 103, 106 and 321 were also seen with these names in files.
The expansion between ambient and a temperature is in no file: it is taken from the grade of
Trunnion's library that has the same column of ASME B31.3 Table C-1; materials without such a
column have their coefficient at 70 F, and say so.  Displacements that version 14 printed for
A106 B at 325 C and for A334 6 at 350 C have the coefficients of ASME II-D Table TE-1 group 1
(7.434 and 7.524e-6/F) to 0.05 %, so that carbon and low alloy steels of late versions have them.
"""

from typing import Any

from trunnion.deck.properties import graded
from trunnion.frozen import frozen
from trunnion.model import Material


@frozen
class Family:
    """Materials that share constants: E [Pa], nu, density [kg/m3], alpha at 70 F [1/K]."""

    name: str
    e: float
    nu: float
    density: float
    alpha: float
    grade: str | None = None  # whose mean expansion holds


def _family(
    name: str, e: float, density: float, alpha: float, grade: str | None = None, nu: float = 0.292
) -> Family:
    return Family(name, e * 1e6, nu, density, alpha * 1e-6, grade)


_CARBON = _family("carbon steel", 203400.0, 7833.44, 10.925, "A106-B")
_HIGH_CARBON = _family("high carbon steel", 202000.0, 7752.89, 10.925, "A106-B", 0.289)
_C_MOLY = _family("carbon moly steel", 201300.0, 7833.44, 10.925, "A335-P11")
_CR1 = _family("low chrome moly steel", 204800.0, 7833.44, 10.925, "A335-P11")
_CR2 = _family("2 1/4 to 3 Cr steel", 211000.0, 7833.44, 10.925, "A335-P22")
_CR5 = _family("5 Cr steel", 213100.0, 7695.04, 10.313, "A335-P5")
_CR9 = _family("9 Cr steel", 213100.0, 7639.68, 10.313, "A335-P9")
_STAINLESS = _family("austenitic stainless steel", 195100.0, 8027.2, 16.397, "A312-TP304")
_SS310 = _family("25 Cr 20 Ni stainless steel", 195100.0, 8027.2, 15.821)
_CR13 = _family("straight chromium steel", 201300.0, 7750.4, 9.4312)
_NICKEL3 = _family("3 1/2 Ni steel", 191700.0, 7750.4, 11.249, nu=0.291)
_DUPLEX = _family("duplex stainless steel", 195100.0, 8027.2, 12.599)

_NUMBERS: tuple[tuple[Family, tuple[int, ...]], ...] = (
    (_CARBON, (1, *range(101, 111), *range(150, 153), 174, 177, *range(303, 311))),
    (_CARBON, (*range(321, 324), *range(330, 333), *range(354, 373), *range(380, 384))),
    (_HIGH_CARBON, (2,)),
    (_C_MOLY, (3, 112, 180, 237)),
    (_CR1, (4, *range(113, 120), *range(181, 184), *range(238, 241), 243, 373, 379)),
    (_CR2, (*range(120, 124), 184, 185, 241, 242)),
    (_CR5, (5, 139, 140, *range(186, 189), 244, 377)),
    (_CR9, (142, 143, 190, 191, 246, 378)),
    (_STAINLESS, (6, *range(124, 128), *range(129, 139), *range(153, 160), *range(163, 174))),
    (_STAINLESS, (*range(192, 200), *range(201, 208), *range(213, 221), *range(222, 237))),
    (_STAINLESS, (*range(247, 259), *range(275, 280), *range(281, 292), *range(294, 303))),
    (_STAINLESS, (*range(324, 329), *range(343, 354), 402)),
    (_SS310, (111, 161, 212, 280)),
    (_CR13, (7, *range(144, 150))),
    (_NICKEL3, (175, 176, 178, 179)),
    (_DUPLEX, (333, 334, *range(337, 343))),
    (_family("type 310 stainless steel", 195100.0, 8024.43, 13.463, nu=0.305), (8,)),
    (_family("grey cast iron", 92390.0, 7080.54, 9.7012, nu=0.211), (10,)),
    (_family("Monel", 179300.0, 8821.62, 13.463, nu=0.315), (11,)),
    (_family("copper-nickel", 151700.0, 9369.68, 14.687, nu=0.33), (13,)),
    (_family("aluminium", 71020.0, 2803.98, 22.048, nu=0.33), (14,)),
    (_family("copper", 110300.0, 8937.87, 16.775, nu=0.355), (15,)),
    (_family("commercial brass", 117200.0, 8472.85, 16.811, nu=0.331), (16,)),
    (_family("leaded tin bronze", 96530.0, 8827.15, 17.225, nu=0.33), (17,)),
)
FAMILIES = {number: family for family, numbers in _NUMBERS for number in numbers}
SAME = 1e-3  # a modulus this near to the grade's is the grade's, which has one at every temperature
IID = "-IID"  # grades of the library with the expansion of ASME II-D Table TE-1
LATE = ("A106-B", "A335-P11", "A335-P22")  # grades that have it
LATE_VERSION = 12.0  # seen: not in 11 (modulus of older codes), in 14
CUT_SHORT, CUT_LONG = 18, 19  # no materials: cold spring
PLASTIC = 20  # fibre reinforced, not isotropic

NAMES = {
    **{1: "LOW_CARBON", 2: "HIGH_CARBON", 3: "CARBON_MOLY", 4: "LOW_CR_MOLY", 5: "MED_CR_MOLY"},
    **{6: "AUSTENITIC", 7: "CHROMIUM", 101: "A53-A", 102: "A53-B", 103: "A105", 104: "A106-A"},
    **{105: "A106-C", 106: "A106-B", 107: "A135-A", 108: "A135-B", 155: "A312-TP304"},
    **{156: "A312-TP304H", 157: "A312-TP304L", 163: "A312-TP316", 164: "A312-TP316H"},
    **{165: "A312-TP316L", 167: "A312-TP317", 168: "A312-TP321", 169: "A312-TP321H"},
    **{170: "A312-TP347", 171: "A312-TP347H", 174: "A333-1", 175: "A333-3", 177: "A333-6"},
    **{180: "A335-P1", 181: "A335-P11", 182: "A335-P12", 183: "A335-P2", 184: "A335-P21"},
    **{185: "A335-P22", 186: "A335-P5", 190: "A335-P9", 191: "A335-P91", 303: "API5L-A"},
    **{305: "API5L-B", 306: "API5L-X65", 307: "API5L-X70", 321: "A234-WPC", 322: "API5L-X60"},
    **{330: "API5L-X42", 331: "API5L-X52", 338: "A790-S31803", 342: "A790-S32750"},
    **{383: "A516-70"},
}


# beginnings of names in capitals, without ASTM and blanks: EN numbers and grades of those families
_CALLED: tuple[tuple[Family, tuple[str, ...]], ...] = (
    (_CARBON, ("1.0305", "1.0345", "1.0348", "1.0352", "1.0425", "1.0460", "1.0481", "1.0565")),
    (_CARBON, ("P235", "P265", "P295GH", "P355", "A106", "A53", "A105", "A234WP", "A333-6")),
    (_C_MOLY, ("1.5415", "16MO3")),
    (_CR1, ("1.7335", "1.7338", "13CRMO4", "10CRMO5")),
    (_CR2, ("1.7380", "1.7383", "10CRMO9")),
    (_STAINLESS, ("1.4301", "1.4306", "1.4307", "1.4401", "1.4404", "1.4432", "1.4435", "1.4436")),
    (_STAINLESS, ("1.4541", "1.4550", "1.4571", "A312", "A358", "A182F304", "A182F316")),
)
_ALLOYED = ("A234WP1", "A234WP5", "A234WP9", "A234WP2", "A234WP11")  # not the carbon steels of it


def family_by_name(name: str) -> Family | None:
    """Give the family of a user's material by its name, where that is one of a standard."""
    plain = name.upper().replace("ASTM", "").replace(" ", "").replace("GRADE", "")
    if plain.replace("-", "").startswith(_ALLOYED):
        return None
    short = plain.replace("-", "")
    for family, heads in _CALLED:
        if plain.startswith(heads) or short.startswith(tuple(h.replace("-", "") for h in heads)):
            return family
    return None


def name_of(number: int) -> str:
    """Name for the deck."""
    return NAMES.get(number, f"MAT{number}")


def material_of(
    name: str, family: Family, e: float, nu: float, density: float, *, late: bool
) -> Material:
    """Material of a family with the file's own modulus, Poisson's ratio and density (0: none).

    Parameters
    ----------
    late : the file is of a version whose data base has the expansion of ASME II-D.
    """
    e, nu, density = e or family.e, nu or family.nu, density or family.density
    if family.grade is None:
        return Material(name, e, nu, family.alpha, density)
    grade = f"{family.grade}{IID}" if late and family.grade in LATE else family.grade
    keys: dict[str, Any] = {"GRADE": grade, "NU": nu, "DENSITY": density}
    if abs(e / graded(name, keys).e - 1.0) > SAME:
        keys["E"] = e
    return graded(name, keys)
