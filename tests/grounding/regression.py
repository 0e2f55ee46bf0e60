"""Scored lists of names: which class, and which words, the lexical grounder reads in each.

A change of the model may trade one case for another; what counts is the share of a group that is right. After such a
change, `python -m tests.grounding.regression` prints the groups and the wrong cases, and with `--update` it writes new
floors to `regression_floors.csv`. `test_regression.py` fails where a group falls below its floor.

`regression.csv`, one object each:

- `group`: what the case is about; cases are scored by group.
- `ontology`: `home`, or a name in `ontologies.py`.
- `name`, `parents`: the prim's name, and the names of the prims above it, outermost first, joined by `/`.
- `size_m`: extents of its bounding box in metres, or empty.
- `evidence`: further fields of `ObjectView`, as `field=value; field=value`; values of lists are joined by `|`.
- `expected`: local name of its class, `(none)` where no class of the ontology is right.
- `also`: further classes that count as right, joined by `|`.
- `reason`: what decides, where the name alone does not show it.

`decorations.csv`, patterns for the objects of the group `undecorated names`: `pattern` is `parent/name`, where `{n}`
becomes `frying_pan`, `{N}` becomes `FryingPan` and `{U}` becomes `FRYING_PAN`. A subclass of the expected class is
right too: metamorphic relations (Chen et al., 1998).

`readings.csv`, the words that a name consists of: `words`, joined by spaces, in the home ontology. In the group
`words: abbreviations`, they are the likeliest words behind the letters.
"""

import argparse
import csv
import math
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from tests.grounding.ontologies import load_ontology
from tests.grounding.records import ground_view, read_abbreviation, read_words
from usd2kg.grounding import ObjectView

__all__ = ["Case", "Floor", "floors", "groups", "score"]

_FOLDER = Path(__file__).parent
_NO_CLASS = "(none)"
_UNDECORATED = "undecorated names"
_ABBREVIATED = "words: abbreviations"
_ALLOWED_LOSS = 0.05
"""Share of a group that a change may lose before the floor is reached, at least `_ALLOWED_CASES`."""
_ALLOWED_CASES = 2


class Case(NamedTuple):
    """One scored case."""

    given: str
    """What the grounder sees, for messages."""
    expected: str
    answered: str
    is_right: bool

    def __str__(self) -> str:
        return f"{self.given}: {self.answered or 'no words'}, expected {self.expected or 'no words'}"


class Floor(NamedTuple):
    """What must hold of a group."""

    cases: int
    percent_right: float


@cache
def groups() -> dict[str, list[dict[str, str]]]:
    """Return the rows of each group, in the order of the files."""
    found: dict[str, list[dict[str, str]]] = {}
    for row in [*_read("regression.csv"), *_home_class_names(), *_decorated(), *_read("readings.csv")]:
        found.setdefault(row["group"], []).append(row)
    return found


@cache
def score(group: str) -> list[Case]:
    """Return the scored cases of a group; each is grounded by itself."""
    return [_score_words(row) if "words" in row else _score_class(row) for row in groups()[group]]


def floors() -> dict[str, Floor]:
    """Return the committed floor of each group."""
    return {
        row["group"]: Floor(int(row["cases"]), float(row["floor_percent"])) for row in _read("regression_floors.csv")
    }


def _read(name: str) -> list[dict[str, str]]:
    with (_FOLDER / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def _home_class_names() -> Iterator[dict[str, str]]:
    """Yield a row for each class of the home ontology: an object with the class's own name."""
    fields = dict.fromkeys(("parents", "size_m", "evidence", "also"), "")
    for cls in load_ontology("home").classes:
        name = cls.local_name
        yield {**fields, "group": "home class names", "ontology": "home", "name": name, "expected": name}


def _decorated() -> Iterator[dict[str, str]]:
    plain = [row for row in _read("regression.csv") if row["group"] == _UNDECORATED]
    for pattern in _read("decorations.csv"):
        for row in plain:
            name = row["name"]
            camel = "".join(word.capitalize() for word in name.split("_"))
            parent, written = pattern["pattern"].format(n=name, N=camel, U=name.upper()).split("/")
            yield {**row, "group": pattern["group"], "name": written, "parents": f"World/{parent}", "subclass": "yes"}


def _score_words(row: dict[str, str]) -> Case:
    if row["group"] == _ABBREVIATED:
        words = read_abbreviation(row["name"].split())
    else:
        words = read_words(row["name"], _split(row["parents"], "/"))
    answered = " ".join(words)
    return Case(_described(row), row["words"], answered, answered == row["words"])


def _score_class(row: dict[str, str]) -> Case:
    tbox = load_ontology(row["ontology"])
    iri = ground_view(_view(row), tbox).class_iri
    right = {row["expected"], *_split(row["also"], "|")}
    above = tbox.closure(iri) if iri and "subclass" in row else {iri}
    names = {tbox.by_iri[cls].local_name if cls else _NO_CLASS for cls in above}
    answered = tbox.by_iri[iri].local_name if iri else _NO_CLASS
    return Case(_described(row), "|".join(sorted(right)), answered, bool(names & right))


def _view(row: dict[str, str]) -> ObjectView:
    fields: dict[str, Any] = {"name": row["name"], "parents": _split(row["parents"], "/")}
    if row["size_m"]:
        fields["size"] = _extents(row["size_m"])
    for entry in _split(row["evidence"], "; "):
        field, _, value = entry.partition("=")
        match field:
            case "masked":
                fields["is_masked"] = value == "yes"
            case "oriented_size":
                fields[field] = _extents(value)
            case "display_name" | "documentation":
                fields[field] = value
            case _:
                fields[field] = _split(value, "|")
    return ObjectView(**fields)


def _extents(text: str) -> tuple[float, float, float]:
    x, y, z = map(float, text.split())
    return x, y, z


def _split(text: str, separator: str) -> tuple[str, ...]:
    return tuple(text.split(separator)) if text else ()


def _described(row: dict[str, str]) -> str:
    known = ("ontology", "parents", "size_m", "evidence")
    return ", ".join([row["name"], *(f"{key}: {row[key]}" for key in known if row.get(key) not in {None, "", "home"})])


def _floor(cases: list[Case]) -> float:
    """Return the percentage right, less the allowed loss, rounded down to a tenth."""
    right = sum(case.is_right for case in cases) - max(_ALLOWED_CASES, _ALLOWED_LOSS * len(cases))
    return max(0.0, math.floor(1000 * right / len(cases)) / 10)


def _main() -> None:
    parser = argparse.ArgumentParser(description="Score the regression lists of the lexical grounder.")
    parser.add_argument("--update", action="store_true", help="write the floors that today's scores give")
    if parser.parse_args().update:
        lines = [f'"{group}",{len(score(group))},{_floor(score(group))}\n' for group in groups()]
        (_FOLDER / "regression_floors.csv").write_text("".join(["group,cases,floor_percent\n", *lines]), "utf-8")
    known = floors()
    print(f"{'group':36}{'cases':>6}{'right':>8}{'floor':>8}")
    for group in groups():
        cases = score(group)
        share = 100 * sum(case.is_right for case in cases) / len(cases)
        floor = f"{known[group].percent_right:6.1f} %" if group in known else "none"
        print(f"{group:36}{len(cases):6}{share:6.1f} %{floor:>8}")
        for case in cases:
            if not case.is_right:
                print(f"    {case}")


if __name__ == "__main__":
    _main()
