"""Accuracy on names alone: lists of things as they are called in scenes, with size, group and class.

Usage: python -m benchmarks.names.run [ONTOLOGY]

Each list holds different things, written and labelled by the authors of this project before any answer was seen, by the
conventions for SOMA-HOME. The grounder was improved on the errors in all but five, of which only the score was looked
at: `unseen`, whose rows were drawn by lot from those of `dwelling` and `work` before anybody saw them, `blind`,
`galley`, of kitchens, and `rare`. That one was drawn by lot with `rarities`, of things that their authors were asked to
think of because few people would: parts, fittings, utensils and tools of trades.
The names of `found` and `wild`, which were parted by lot, are none that the authors thought of: they are those of
prims, nodes and models in public repositories, which `source` names; the sizes are estimates.
Where labellers who did not know of each other agreed on a convention, the home vocabulary follows them.
`second_labels.csv` has what another labeller, who saw no label, calls 400 things of `unseen` and `blind`, and another
those of `wild`: how often the two agree is what any grounder can be expected to.
Without an ontology the built-in home TBox is used.
"""

import csv
import sys
from collections.abc import Collection
from pathlib import Path
from typing import NamedTuple

from benchmarks.bare import bare_object, bare_scene
from usd2kg.grounding import NamingRegime, ground
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import SceneObject

HERE = Path(__file__).parent
TRAIN = (
    "kitchen",
    "home",
    "sim",
    "dwelling",
    "work",
    "rooms",
    "homes",
    "parts",
    "studios",
    "cooking",
    "living",
    "working",
    "stoves",
    "assets",
    "links",
    "trades",
    "dwellings",
    "pantries",
    "joints",
    "places",
    "sets",
    "props",
    "rarities",
    "lived",
    "found",
)
TEST = ("unseen", "blind", "galley", "rare", "wild")


class Thing(NamedTuple):
    """One row."""

    obj: SceneObject
    target: ClassIRI
    accepted: frozenset[ClassIRI]
    """The target and what a careful person would defend too."""


class Figures(NamedTuple):
    """What a list was grounded to, in %."""

    exact: float
    also: float
    """Answers that are accepted."""
    confidence: float
    """What the grounder says, on average, of being exactly right."""

    def __str__(self) -> str:
        return f"{self.exact:.1f} ({self.also:.1f})"


def main() -> None:
    """Measure and print."""
    tbox = open_tbox(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
    print("list      n    semantic (also)  abbreviated (also)")
    for name in (*TRAIN, *TEST):
        things = load(HERE / f"{name}.csv", tbox)
        figures = [measure(things, tbox, regime) for regime in (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED)]
        print(f"{name:<9} {len(things)}  " + "     ".join(map(str, figures)))
    for names in (("unseen", "blind"), ("wild",)):
        firsts, seconds = twice_labelled(HERE, "second_labels.csv", names, tbox)
        print(f"\n{len(firsts)} of {' and '.join(names)}: {told_by_two(firsts, seconds, tbox)}")


def told_by_two(firsts: list[Thing], seconds: list[Thing], tbox: TBox) -> str:
    """Return how often two labellers agree, and the grounder with each."""
    exact, also = agreement(firsts, seconds)
    told = [measure(things, tbox, NamingRegime.SEMANTIC) for things in (firsts, seconds)]
    return (
        f"a second labeller against the first {exact:.1f} ({also:.1f});\n"
        f"the grounder against the first {told[0]}, against the second {told[1]}"
    )


def twice_labelled(folder: Path, file_name: str, names: Collection[str], tbox: TBox) -> tuple[list[Thing], list[Thing]]:
    """Return the things of some lists that two have labelled, with the labels of the first and of the second."""
    labelled = {
        (name, found.obj.name, found.obj.prim_path.split("/")[-2]): found
        for name in names
        for found in load(folder / f"{name}.csv", tbox)
    }
    with (folder / file_name).open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["list"] in names]
    firsts = [labelled[row["list"], row["name"], row["parent"]] for row in rows]
    seconds = [Thing(first.obj, *labels_of(row, tbox)) for first, row in zip(firsts, rows, strict=True)]
    return firsts, seconds


def agreement(firsts: list[Thing], seconds: list[Thing]) -> tuple[float, float]:
    """Return how often in % the second labeller has the first one's class, and one that the first accepts."""
    right = [two.target == one.target for one, two in zip(firsts, seconds, strict=True)]
    accepted = [two.target in one.accepted for one, two in zip(firsts, seconds, strict=True)]
    return 100 * sum(right) / len(right), 100 * sum(accepted) / len(accepted)


def load(path: Path, tbox: TBox) -> list[Thing]:
    """Return the things of a list."""
    with path.open(encoding="utf-8", newline="") as file:
        return [thing(row, tbox) for row in csv.DictReader(file)]


def thing(row: dict[str, str], tbox: TBox) -> Thing:
    """Return the thing of one row, standing at the origin."""
    size = (float(row["long_m"]), float(row["middle_m"]), float(row["short_m"]))
    return Thing(bare_object(f"/World/{row['parent']}/{row['name']}", size), *labels_of(row, tbox))


def labels_of(row: dict[str, str], tbox: TBox) -> tuple[ClassIRI, frozenset[ClassIRI]]:
    """Return the class of a row, and all that are accepted."""
    target = tbox.resolve(row["class"])
    others = [tbox.resolve(name) for name in (row["also"] or "").split("|") if name]
    return target, frozenset([target, *others])


def measure(things: list[Thing], tbox: TBox, regime: NamingRegime) -> Figures:
    """Ground a list and return how well that was done."""
    scene = bare_scene("a list of names", [found.obj for found in things])
    answers = ground(scene, tbox, regime=regime).by_path
    told = [(found, answers[found.obj.prim_path]) for found in things]
    return Figures(
        exact=100 * sum(answer.class_iri == found.target for found, answer in told) / len(told),
        also=100 * sum(answer.class_iri in found.accepted for found, answer in told) / len(told),
        confidence=100 * sum(answer.confidence or 0.0 for _, answer in told) / len(told),
    )


if __name__ == "__main__":
    main()
