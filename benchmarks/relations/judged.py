"""Compare found spatial relations with manual judgements.

Usage: python -m benchmarks.relations.judged [SCENE...] (default: all)

The lists are in `judged`; `on` and `inside` of the demo kitchen are written with the scene. The real scenes are read
from the folder that the variable USD2KG_SHARED names, `../shared` by default, the FZK house from the Debian package
assimp-testmodels, or the folder USD2KG_ASSIMP_MODELS; `benchmarks.scenes.garage.build` writes the garage,
`benchmarks.scenes.salon.build` the salon. A missing one is skipped.
"""

import csv
import math
import os
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import usd2kg
from benchmarks.intervals import wilson
from benchmarks.labelled_scenes import ROOT, SHARED
from benchmarks.scenes.garage.build import COMMAND as BUILD_GARAGE
from benchmarks.scenes.garage.build import STAGE as GARAGE
from benchmarks.scenes.salon.build import COMMAND as BUILD_SALON
from benchmarks.scenes.salon.build import STAGE as SALON
from usd2kg.demo import demo_relations, demo_scene
from usd2kg.relations import Relation

HERE = Path(__file__).parent
KINDS = ("on", "inside", "part-of", "attached-to", "room", "touching")
ANY = "*"
ASSIMP_MODELS = Path(os.environ.get("USD2KG_ASSIMP_MODELS", "/usr/share/assimp/models"))


class Sources(NamedTuple):
    """A scene and its judged lists."""

    stage: Path
    judged: tuple[Path, ...]
    remedy: str = "set USD2KG_SHARED"
    """What provides the stage where it is missing."""
    is_test: bool = False
    """Whether it is only scored: its errors are not read, so that its figures stay a test."""


SCENES = {
    "demo_kitchen": Sources(demo_scene(), (demo_relations(), HERE / "judged/demo_kitchen.csv")),
    "apartment": Sources(SHARED / "scenes/iai_apartment/apartment.usdc", (HERE / "judged/apartment.csv",)),
    "small_house": Sources(SHARED / "scenes/aws_robomaker/small_house.usdc", (HERE / "judged/small_house.csv",)),
    "bookstore": Sources(SHARED / "scenes/aws_robomaker/bookstore.usdc", (HERE / "judged/bookstore.csv",)),
    "small_warehouse": Sources(
        SHARED / "scenes/aws_robomaker/small_warehouse.usdc", (HERE / "judged/small_warehouse.csv",)
    ),
    "office": Sources(ROOT / "benchmarks/scenes/office/office.usda", (HERE / "judged/office.csv",)),
    "dlr_kitchen": Sources(SHARED / "scenes/dlr_kitchen/source/dlr_kitchen.usda", (HERE / "judged/dlr_kitchen.csv",)),
    "franka_kitchen": Sources(
        SHARED / "scenes/franka_kitchen/franka_kitchen.usdc", (HERE / "judged/franka_kitchen.csv",)
    ),
    "island_kitchen": Sources(
        ROOT / "benchmarks/scenes/island_kitchen/island_kitchen.usdc", (HERE / "judged/island_kitchen.csv",)
    ),
    "fzk_house": Sources(
        ASSIMP_MODELS / "IFC/AC14-FZK-Haus.ifc", (HERE / "judged/fzk_house.csv",), "install assimp-testmodels"
    ),
    "warehouse": Sources(ROOT / "benchmarks/scenes/warehouse/warehouse.usda", (HERE / "judged/warehouse.csv",)),
    "garage": Sources(GARAGE, (HERE / "judged/garage.csv",), f"run {BUILD_GARAGE}"),
    "salon": Sources(SALON, (HERE / "judged/salon.csv",), f"run {BUILD_SALON}"),
    "bicycle_shop": Sources(
        ROOT / "benchmarks/scenes/bicycle_shop/bicycle_shop.usdc", (HERE / "judged/bicycle_shop.csv",)
    ),
    "pottery": Sources(ROOT / "benchmarks/scenes/pottery/pottery.usdc", (HERE / "judged/pottery.csv",)),
    "hotel": Sources(ROOT / "benchmarks/scenes/hotel/hotel.usdc", (HERE / "judged/hotel.csv",)),
    "vet": Sources(ROOT / "benchmarks/scenes/vet/vet.usdc", (HERE / "judged/vet.csv",)),
    "bakery": Sources(ROOT / "benchmarks/scenes/bakery/bakery.usdc", (HERE / "judged/bakery.csv",), is_test=True),
}


class Fact(NamedTuple):
    """A row of a judged list: one of the relations to one of the objects holds, or is open."""

    subject: str
    kinds: tuple[str, ...]
    objects: tuple[str, ...]
    is_open: bool

    def covers(self, subject: str, kind: str, anchor: str) -> bool:
        """Return whether this row covers a relation; `touching` is symmetric."""
        pairs = [(subject, anchor)] if kind != "touching" else [(subject, anchor), (anchor, subject)]
        return kind in self.kinds and any(
            s == self.subject and (o in self.objects or ANY in self.objects) for s, o in pairs
        )


@dataclass
class Tally:
    """Found and true relations of one kind, as pairs of prim paths."""

    judged: int = 0
    """Rows that are true."""
    right: list[tuple[str, str]] = field(default_factory=list)
    wrong: list[tuple[str, str]] = field(default_factory=list)
    open: list[tuple[str, str]] = field(default_factory=list)
    missed: list[tuple[str, str]] = field(default_factory=list)

    @property
    def precision(self) -> float:
        """Precision without open cases; NaN if nothing was found."""
        return _share(len(self.right), len(self.right) + len(self.wrong))

    @property
    def recall(self) -> float:
        """Recall; NaN if nothing is true."""
        return _share(self.judged - len(self.missed), self.judged)


def read_judged(path: Path) -> list[Fact]:
    """Return the rows of a judged list."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return [
        Fact(
            row["subject"],
            tuple(row["relation"].removeprefix("?").split("|")),
            tuple(row["object"].split("|")),
            row["relation"].startswith("?"),
        )
        for row in rows
    ]


def compare(facts: Iterable[Fact], found: Iterable[Relation]) -> dict[str, Tally]:
    """Return kind → tally, for the kinds and objects of the list."""
    facts = list(facts)
    by_subject: dict[str, list[Fact]] = {}
    for fact in facts:
        by_subject.setdefault(fact.subject, []).append(fact)
    kinds = [kind for kind in KINDS if any(kind in fact.kinds for fact in facts)]
    tallies = {kind: Tally() for kind in kinds}
    links = [(r.target, r.kind, r.anchor) for r in found if r.kind in tallies and r.target in by_subject]
    for target, kind, anchor in links:
        covering = [f for f in (*by_subject[target], *by_subject.get(anchor, ())) if f.covers(target, kind, anchor)]
        tally = tallies[kind]
        place = tally.wrong if not covering else tally.open if all(fact.is_open for fact in covering) else tally.right
        place.append((target, anchor))
    known = _Known(links)
    for fact in facts:
        if not fact.is_open and fact.kinds != ("nothing",):
            tally = tallies[fact.kinds[0]]
            tally.judged += 1
            if not known.meets(fact):
                tally.missed.append((fact.subject, "|".join(fact.objects)))
    return tallies


class _Known:
    """Index of the found relations."""

    def __init__(self, links: Iterable[tuple[str, str, str]]) -> None:
        self._links = set(links)

    def meets(self, fact: Fact) -> bool:
        """Return whether one of the relations of a row was found."""
        tries = [(fact.subject, kind, anchor) for kind in fact.kinds for anchor in fact.objects]
        turned = [(o, kind, s) for s, kind, o in tries if kind == "touching"]
        return any(link in self._links for link in (*tries, *turned))


def table(name: str, tallies: Mapping[str, Tally]) -> list[str]:
    """Return one Markdown row per kind."""
    rows = []
    for kind, tally in tallies.items():
        right, wrong, open_, missed = (len(x) for x in (tally.right, tally.wrong, tally.open, tally.missed))
        counts = [tally.judged, right + wrong + open_, right, wrong, open_, missed]
        shares = [_percent(right, right + wrong), _percent(tally.judged - missed, tally.judged)]
        rows.append(f"| {' | '.join([name, kind, *map(str, counts), *shares])} |")
    return rows


def errors(tallies: Mapping[str, Tally]) -> list[str]:
    """Return one line per false positive or false negative."""
    lines = []
    for kind, tally in tallies.items():
        for word, pairs in (("wrong", tally.wrong), ("missed", tally.missed)):
            lines += [f"{word}: {target} {kind} {anchor}" for target, anchor in sorted(pairs)]
    return lines


def main(names: list[str]) -> None:
    """Print the table and the errors."""
    unknown = [name for name in names if name not in SCENES]
    if unknown:
        sys.exit(f"judged.py: scene {unknown[0]!r} is unknown; expected one of {', '.join(SCENES)}")
    rows = [
        "| scene | relation | judged | found | right | wrong | open | missed | precision % | recall % |",
        "|" + " --- |" * 10,
    ]
    errors_and_notes = []
    for name in names or SCENES:
        source = SCENES[name]
        if not source.stage.exists():
            errors_and_notes.append(f"{name} is skipped: {source.stage} is missing; {source.remedy}")
            continue
        facts = [fact for path in source.judged for fact in read_judged(path)]
        tallies = compare(facts, usd2kg.build(source.stage).graph.relations)
        rows += table(name, tallies)
        if source.is_test:
            errors_and_notes.append(f"{name} is a test: its errors are not listed")
        else:
            errors_and_notes += [f"{name}: {line}" for line in errors(tallies)]
    print("\n".join([*rows, "", *errors_and_notes]))


def _share(part: int, whole: int) -> float:
    return part / whole if whole else math.nan


def _percent(part: int, whole: int) -> str:
    if not whole:
        return "–"
    lower, upper = (100 * end for end in wilson(part, whole))
    return f"{100 * part / whole:.1f} ({lower:.1f} to {upper:.1f})"


if __name__ == "__main__":
    main(sys.argv[1:])
