"""Accuracy on names alone: lists of things as they are called in scenes, with size, group and class.

Usage: python -m benchmarks.names.run [ONTOLOGY]

Each list holds different things, written and labelled by the authors of this project before any answer was seen, by the
conventions for SOMA-HOME. The grounder was improved on the errors in all but three, of which only the score was looked
at: `unseen`, whose rows were drawn by lot from those of `dwelling` and `work` before anybody saw them, `blind`, and
`galley`, of kitchens.
Where labellers who did not know of each other agreed on a convention, the home vocabulary follows them.
Without an ontology the built-in home TBox is used.
"""

import csv
import sys
from pathlib import Path
from typing import NamedTuple

from benchmarks.bare import bare_object, bare_scene
from usd2kg.grounding import ground
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import NamingRegime, SceneObject

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
)
TEST = ("unseen", "blind", "galley")


class Thing(NamedTuple):
    """One row."""

    obj: SceneObject
    target: ClassIRI
    accepted: frozenset[ClassIRI]
    """The target and what a careful person would defend too."""


def main() -> None:
    """Measure and print."""
    tbox = open_tbox(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
    print("list     n    semantic (also)  abbreviated (also)")
    for name in (*TRAIN, *TEST):
        things = load(HERE / f"{name}.csv", tbox)
        figures = [measure(things, tbox, regime) for regime in (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED)]
        print(f"{name:<8} {len(things)}  " + "     ".join(f"{exact:.1f} ({also:.1f})" for exact, also in figures))


def load(path: Path, tbox: TBox) -> list[Thing]:
    """Return the things of a list."""
    with path.open(encoding="utf-8", newline="") as file:
        return [thing(row, tbox) for row in csv.DictReader(file)]


def thing(row: dict[str, str], tbox: TBox) -> Thing:
    """Return the thing of one row, standing at the origin."""
    size = (float(row["long_m"]), float(row["middle_m"]), float(row["short_m"]))
    obj = bare_object(f"/World/{row['parent']}/{row['name']}", size)
    target = tbox.resolve(row["class"])
    others = [tbox.resolve(name) for name in (row["also"] or "").split("|") if name]
    return Thing(obj, target, frozenset([target, *others]))


def measure(things: list[Thing], tbox: TBox, regime: NamingRegime) -> tuple[float, float]:
    """Return the share in % that is exactly right, and that is accepted."""
    scene = bare_scene("a list of names", [found.obj for found in things])
    answers = ground(scene, tbox, regime=regime).by_path
    right = [answers[found.obj.prim_path].class_iri == found.target for found in things]
    accepted = [answers[found.obj.prim_path].class_iri in found.accepted for found in things]
    return 100 * sum(right) / len(things), 100 * sum(accepted) / len(things)


if __name__ == "__main__":
    main()
