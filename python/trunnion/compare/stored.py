"""A JSON report read back: checked as far as the commands lean on it."""

import json
import math
import sys
from pathlib import Path
from typing import Any, NoReturn

from trunnion.errors import ModelError, Problem

Report = dict[str, Any]
MAX_BYTES = 4_000_000_000
LARGEST = sys.float_info.max  # 1e999 is read as infinity
TABLES = ("nodes", "supports", "elements")  # of a case with numbers
#: what reading tables raises that are those of another deck, or none at all
SHAPE = (KeyError, IndexError, TypeError, ValueError, AttributeError)
VECTORS = {"supports": ("force", "moment"), "elements": ("force_from", "force_to")}


def read_report(path: Path) -> Report:
    """Read <stem>.json.

    Raises
    ------
    ModelError : it cannot be read, or is no result of Trunnion.
    """
    try:
        if path.stat().st_size > MAX_BYTES:
            refuse(path, f"larger than {MAX_BYTES // 10**9} GB")
        report = json.loads(
            path.read_bytes(),
            parse_constant=lambda word: refuse(path, word),
            parse_int=lambda digits: _whole(path, digits),
        )
    except ModelError:
        raise
    except OSError as error:
        refuse(path, error.strerror or "cannot be read")
    except (ValueError, RecursionError) as error:
        refuse(path, f"no JSON, as trunnion run writes it: {error}")
    if not isinstance(report, dict) or report.get("schema") != 1:
        refuse(path, 'no result of trunnion run: "schema" is not 1')
    cases = report.get("cases")
    if not isinstance(cases, dict) or not all(isinstance(case, dict) for case in cases.values()):
        refuse(path, '"cases" is no table of cases')
    for name, case in cases.items():
        fault = _fault(case)
        if fault:
            refuse(path, f"case {name}: {fault}")
    return report


def refuse(path: Path, message: str) -> NoReturn:
    """Refuse a stored result."""
    raise ModelError([Problem(path.name, message)])


def _whole(path: Path, digits: str) -> int:
    """Read a whole number that has a place among floating-point numbers."""
    if len(digits) > 300 and math.isinf(float(digits)):
        refuse(path, f"a whole number of {len(digits.lstrip('-'))} digits, beyond 1e308")
    return int(digits)


def _fault(case: Report) -> str:
    """Say what a case lacks; nothing if all is there."""
    if not isinstance(case.get("converged"), bool):
        return '"converged" is not true or false'
    if not case["converged"]:
        return ""
    for table in TABLES:
        if not isinstance(case.get(table), dict if table == "nodes" else list):
            return f'"{table}" is missing'
    if not all(_six(value, 6) for value in case["nodes"].values()):
        return '"nodes" has an entry that is not six numbers'
    for table, names in VECTORS.items():
        for entry in case[table]:
            if not isinstance(entry, dict) or not isinstance(entry.get("id"), str):
                return f'"{table}" has an entry without "id"'
            for name in names:
                if not _six(entry.get(name), 3 if table == "supports" else 6):
                    return f'"{name}" of {entry["id"]} is not a row of numbers'
    return ""


def _six(value: object, count: int) -> bool:
    return (
        isinstance(value, list)
        and len(value) == count
        and all(
            isinstance(x, int | float) and not isinstance(x, bool) and abs(x) <= LARGEST
            for x in value
        )
    )
