"""Score answers to questions in people's own words about twelve scenes.

Usage: python -m benchmarks.questions.run [--split train|test] [--note TEXT] [--show]

README.md describes the questions. An answer is right, wrong, or refused: the product says that it did not understand,
or does not know. Prints the shares with 95 % intervals (Wilson), by kind of question; `--show` lists what is not right,
but for held-out questions. A missing scene is skipped; `benchmarks.scenes.garage.build` and
`benchmarks.scenes.salon.build` write two of them.
"""

import argparse
import csv
import re
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

import usd2kg
from benchmarks.intervals import wilson
from benchmarks.labelled_scenes import ROOT, SHARED
from benchmarks.scenes.garage.build import COMMAND as BUILD_GARAGE
from benchmarks.scenes.garage.build import STAGE as GARAGE
from benchmarks.scenes.salon.build import COMMAND as BUILD_SALON
from benchmarks.scenes.salon.build import STAGE as SALON
from usd2kg.assistant import ask_offline
from usd2kg.demo import demo_scene
from usd2kg.errors import GraphError
from usd2kg.query import GraphStore

TABLE = Path(__file__).parent / "questions.csv"
SCENES = {
    "office": ROOT / "benchmarks/scenes/office/office.usda",
    "small_house": SHARED / "scenes/aws_robomaker/small_house.usdc",
    "bookstore": SHARED / "scenes/aws_robomaker/bookstore.usdc",
    "warehouse": SHARED / "scenes/aws_robomaker/small_warehouse.usdc",
    "franka": SHARED / "scenes/franka_kitchen/franka_kitchen.usdc",
    "apartment": SHARED / "scenes/iai_apartment/apartment.usdc",
    "depot": ROOT / "benchmarks/scenes/warehouse/warehouse.usda",
    "island": ROOT / "benchmarks/scenes/island_kitchen/island_kitchen.usdc",
    "salon": SALON,
    "bicycle_shop": ROOT / "benchmarks/scenes/bicycle_shop/bicycle_shop.usdc",
    "garage": GARAGE,
}
"""Name in the table → stage, but for the demo kitchen."""
REMEDIES = {"salon": f"run {BUILD_SALON}", "garage": f"run {BUILD_GARAGE}"}
"""Name → what provides its stage where it is missing, but for those below `SHARED`."""
HELD_OUT = "heldout"
"""Ends the notes of questions whose errors nobody reads."""
RIGHT, WRONG, REFUSED = "right", "wrong", "refused"


def main() -> None:
    """Ask, score and print."""
    parser = argparse.ArgumentParser(description="Score answers to questions in people's own words.")
    parser.add_argument("--split", choices=("train", "test"), default="train")
    parser.add_argument("--scenes", nargs="+", choices=("kitchen", *SCENES), help="default: all scenes")
    parser.add_argument("--note", help='only questions whose note begins so: "sixth heldout", "former test"')
    parser.add_argument("--show", action="store_true", help="list the questions that are not answered right")
    options = parser.parse_args()
    outcomes: dict[str, Counter[str]] = {}
    for row in csv.DictReader(TABLE.open(encoding="utf-8", newline="")):
        if row["split"] != options.split or (options.scenes and row["scene"] not in options.scenes):
            continue
        if options.note and row["note"].partition("; ")[0] != options.note:
            continue
        graph = open_scene(row["scene"])
        if graph is None:
            continue
        outcome, said = ask(graph, row)
        for kind in (row["kind"], "all"):
            outcomes.setdefault(kind, Counter())[outcome] += 1
        if options.show and outcome != RIGHT and not row["note"].endswith(HELD_OUT):
            print(f"{row['id']:5}{outcome:9}{row['kind']:13}{row['question']}\n{'':14}{said}\n{'':14}{row['expected']}")
    print(f"{'kind':14}{'n':>4}  {'right':20}wrong  refused")
    for kind, counts in sorted(outcomes.items(), key=lambda item: item[0] == "all"):
        total = sum(counts.values())
        low, high = wilson(counts[RIGHT], total)
        share = f"{100 * counts[RIGHT] / total:5.1f} [{100 * low:4.1f}–{100 * high:5.1f}]"
        print(f"{kind:14}{total:>4}  {share:20}{counts[WRONG]:>5}{counts[REFUSED]:>9}")


@cache
def open_scene(name: str) -> GraphStore | None:
    """Return the graph of a scene; None if it is absent."""
    scene: Any = demo_scene() if name == "kitchen" else SCENES[name]
    if isinstance(scene, Path) and not scene.exists():
        print(f"not measured: {name}, {scene} is missing; {REMEDIES.get(name, 'set USD2KG_SHARED')}")
        return None
    path = Path("build") / "questions" / f"{name}.ttl"
    path.parent.mkdir(parents=True, exist_ok=True)
    usd2kg.write_graph(usd2kg.build(scene).graph, path)
    return usd2kg.load_graph(path)


def ask(graph: GraphStore, row: dict[str, str]) -> tuple[str, str]:
    """Return the outcome, and what was said."""
    kind, expected = row["kind"], split(row["expected"])
    try:
        asked = ask_offline(graph, row["question"])
    except GraphError as error:
        text = str(error)
        is_right = kind == "unanswerable" or (kind == "absent" and " no " in f" {text}")
        return RIGHT if is_right else REFUSED, text
    paths = [cells for column, cells in columns(asked.answer) if column == "path"]
    found = {cell for cells in paths for cell in cells if cell}
    said = f"{asked.sentence} {sorted(found)}"
    accepted = expected | split(row["also"])
    is_right = {
        "objects": lambda: expected <= found <= accepted,
        "number": lambda: is_number(asked.number, row["expected"]),
        "yesno": lambda: asked.verdict is (row["expected"] == "yes"),
        "absent": lambda: asked.verdict is False or not asked.answer.rows,
        "none": lambda: not asked.answer.rows and asked.verdict is not True,
        "text": lambda: any(re.search(rf"\b{re.escape(word)}", asked.sentence.lower()) for word in expected),
        "place": lambda: bool(asked.places) and asked.places[0] in accepted,
        "unanswerable": lambda: False,
    }[kind]()
    return RIGHT if is_right else WRONG, said


def columns(answer: Any) -> list[tuple[str, list[str | None]]]:
    """Return each column of an answer with its cells."""
    return [(column, [row[at] for row in answer.rows]) for at, column in enumerate(answer.columns)]


def split(text: str) -> set[str]:
    """Return the alternatives in a cell."""
    return set(filter(None, text.split("|")))


def is_number(value: float | None, expected: str) -> bool:
    """Return whether a value is within the tolerance of `9.4±0.05`."""
    number, _, tolerance = expected.partition("±")
    return value is not None and abs(value - float(number)) <= float(tolerance) + 1e-9


if __name__ == "__main__":
    main()
