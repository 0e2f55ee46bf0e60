"""Measure accuracy on names alone with ontologies whose labels are in another language.

Usage: python -m benchmarks.ontologies.run_languages

`labels/ONTOLOGY.LANGUAGE.csv` has a label of each class, written by somebody who had seen neither the glossaries of
usd2kg nor a name of the lists. Prints exact match and accepted answers in % with 95 % intervals (Wilson) where each
class has one label and a number as its IRI: in English, in the other language with its tag, and there without a tag.
"""

import csv
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from benchmarks.names.lists import LabelledName, iter_ontology_lists, resolve_list
from benchmarks.names.scores import tally_answers
from usd2kg.ontology import ClassIRI, TBox

LABELS = Path(__file__).parent / "labels"
_BASE = "https://example.org/numbered#C"


def main() -> None:
    """Measure and print."""
    print(f"{'list':<24}{'language':<14}{'n':>4}  {'exact':<17}  {'accepted':<17}")
    for names, tbox in iter_ontology_lists(("train",)):
        for file in sorted(LABELS.glob(f"{names.ontology}.*.csv")):
            language = file.suffixes[0].removeprefix(".")
            for title, labelled, resolved in _variants(tbox, _read(file), language, resolve_list(names, tbox)):
                tally = tally_answers(resolved, labelled)
                print(f"{names.name:<24}{title:<14}{tally.count:>4}  {tally}", flush=True)


def _read(file: Path) -> dict[str, str]:
    """Return local name → label."""
    return {row["class"]: row["label"] for row in csv.DictReader(file.read_text("utf-8").splitlines())}


def _variants(
    tbox: TBox, labels: dict[str, str], language: str, names: list[LabelledName]
) -> Iterator[tuple[str, TBox, list[LabelledName]]]:
    number = {cls.iri: f"{_BASE}{index:04}" for index, cls in enumerate(tbox.classes)}
    moved = [
        name._replace(target=number[name.target], accepted=frozenset(number[iri] for iri in name.accepted), second=None)
        for name in names
    ]
    english = {cls.iri: cls.label for cls in tbox.classes}
    other = {cls.iri: labels[cls.local_name] for cls in tbox.classes}
    yield "en", _relabelled(tbox, number, english, ""), moved
    yield language, _relabelled(tbox, number, other, language), moved
    yield f"{language}, no tag", _relabelled(tbox, number, other, ""), moved


def _relabelled(tbox: TBox, number: dict[ClassIRI, ClassIRI], labels: dict[ClassIRI, str], language: str) -> TBox:
    """Return the TBox with these labels and IRIs, and without other texts."""
    classes = tuple(
        replace(
            cls,
            iri=number[cls.iri],
            label=labels[cls.iri],
            alt_labels=(),
            comment="",
            parents=tuple(number[iri] for iri in cls.parents),
            equivalents=(),
            foreign_names=((language, labels[cls.iri]),) if language else (),
        )
        for cls in tbox.classes
    )
    return replace(tbox, classes=classes, content_hash=f"{tbox.content_hash} {language} {labels[tbox.classes[0].iri]}")


if __name__ == "__main__":
    main()
