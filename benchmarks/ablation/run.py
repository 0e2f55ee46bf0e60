"""Switch off each rule of the lexical grounder and count the answers that change.

Usage: python -m benchmarks.ablation.run [--workers N] [--only TEXT] [--set TEXT ...]

Counts exact answers gained and lost without the rule, on material that may be learned from: every eighth training name
in the home TBox (spelled out, and every 24th abbreviated), all training lists with other ontologies, and the labelled
training scenes. Without --only the table is written to README.md beside this file. `--set` switches rules off together.
"""

import argparse
import multiprocessing
import os
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

from benchmarks.ablation.rules import RULES, switched_off
from benchmarks.bare import bare_scene
from benchmarks.labelled_scenes import iter_training_scenes
from benchmarks.names.lists import iter_ontology_lists, resolve_home_lists, resolve_list
from usd2kg.grounding import NamingRegime, ObjectView, view_objects
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import Scene
from usd2kg.table_cache import TABLE_CACHE_VARIABLE

HERE = Path(__file__).parent
SEPARATOR = "<!-- table -->"
STEP = 8
COLUMNS = ("names", "abbreviated", "own ontologies", "public ontologies", "scenes")


class Sample(NamedTuple):
    """Views that are grounded together, and their classes."""

    column: str
    tbox: TBox
    views: Sequence[tuple[str, ObjectView]]
    targets: Sequence[ClassIRI]


class Change(NamedTuple):
    """Exact answers gained and lost."""

    gained: int
    lost: int

    def __str__(self) -> str:
        return f"+{self.gained} -{self.lost}" if self.gained or self.lost else "0"


@cache
def samples() -> tuple[Sample, ...]:
    """Return all samples, the same in each process."""
    return (*samples_of_names(), *samples_of_ontologies(), *samples_of_scenes())


def samples_of_names() -> Iterator[Sample]:
    """Yield the lists of names with the home TBox."""
    home = open_tbox(None)
    for names in resolve_home_lists("train", home):
        for column, regime, step in (
            ("names", NamingRegime.SEMANTIC, STEP),
            ("abbreviated", NamingRegime.ABBREVIATED, 3 * STEP),
        ):
            chosen = names[::step]
            scene = bare_scene("names", [name.obj for name in chosen])
            yield sample_of(column, scene, regime, home, {name.obj.prim_path: name.target for name in chosen})


def samples_of_ontologies() -> Iterator[Sample]:
    """Yield the lists of names with other ontologies."""
    for column, is_public in (("own ontologies", False), ("public ontologies", True)):
        for rows, tbox in iter_ontology_lists(("train",), public=is_public):
            names = resolve_list(rows, tbox)
            scene = bare_scene("names", [name.obj for name in names])
            targets = {name.obj.prim_path: name.target for name in names}
            yield sample_of(column, scene, NamingRegime.SEMANTIC, tbox, targets)


def samples_of_scenes() -> Iterator[Sample]:
    """Yield the labelled scenes that are not tests, spelled out and abbreviated."""
    for labelled in iter_training_scenes():
        targets = {label.prim_path: label.target for label in labelled.gold}
        for regime in (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED):
            yield sample_of("scenes", labelled.scene, regime, labelled.tbox, targets)


def sample_of(column: str, scene: Scene, regime: NamingRegime, tbox: TBox, targets: dict[str, ClassIRI]) -> Sample:
    """Return one scene in one naming regime as a sample."""
    views = [(obj.prim_path, view) for obj, view in view_objects(scene, regime) if obj.prim_path in targets]
    return Sample(column, tbox, views, [targets[path] for path, _ in views])


def answers(names: Sequence[str]) -> list[tuple[str, bool]]:
    """Return (column, whether the answer is exact) for each object without the named rules.

    Runs in a child process, since grounders are cached by TBox, without the tables of other processes.
    """
    os.environ[TABLE_CACHE_VARIABLE] = "off"
    with switched_off([rule for rule in RULES if rule.name in names]):
        return [
            (sample.column, prediction.class_iri == target)
            for sample in samples()
            for prediction, target in zip(
                LexicalGrounder().ground_views(sample.views, sample.tbox), sample.targets, strict=True
            )
        ]


def changes(before: Sequence[tuple[str, bool]], after: Sequence[tuple[str, bool]]) -> list[Change]:
    """Return the change in each column."""
    pairs = [(column, was, now) for (column, was), (_, now) in zip(before, after, strict=True)]
    return [
        Change(
            sum(now and not was for found, was, now in pairs if found == column),
            sum(was and not now for found, was, now in pairs if found == column),
        )
        for column in COLUMNS
    ]


def row(name: str, cells: Sequence[object]) -> str:
    """Return one row of the table."""
    return f"| {name} | " + " | ".join(map(str, cells)) + " |"


def main() -> None:
    """Measure, print, and write the table."""
    parser = argparse.ArgumentParser(description="Count the answers that change without each rule.")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--only", default="", help="measure the rules whose name contains this text, and print only")
    parser.add_argument("--set", nargs="+", default=(), help="switch rules off together, by parts of their names")
    arguments = parser.parse_args()
    chosen = [rule for rule in RULES if arguments.only in rule.name]
    sets = [[], *([rule.name] for rule in chosen)]
    if arguments.set:
        sets = [[], [rule.name for rule in RULES if any(text in rule.name for text in arguments.set)]]
    samples()  # Forked children share it.
    with multiprocessing.get_context("fork").Pool(arguments.workers, maxtasksperchild=1) as pool:
        base, *results = pool.map(answers, sets, chunksize=1)
    counts = [sum(column == found for found, _ in base) for column in COLUMNS]
    lines = [
        row("rule switched off", COLUMNS),
        "| --- |" + " --- |" * len(COLUMNS),
        row("number of objects", counts),
        row("exact", [sum(ok for found, ok in base if found == column) for column in COLUMNS]),
        *(row(", ".join(names), changes(base, result)) for names, result in zip(sets[1:], results, strict=True)),
    ]
    print("\n".join(lines))
    if not arguments.only and not arguments.set:
        readme = HERE / "README.md"
        text, _, _ = readme.read_text("utf-8").partition(SEPARATOR)
        readme.write_text(f"{text}{SEPARATOR}\n\n" + "\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
