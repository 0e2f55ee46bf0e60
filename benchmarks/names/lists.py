"""Labelled object names: reading the tables `benchmarks/names/names.csv` and `benchmarks/ontologies/names.csv`.

A row is one object: its name, the name of its parent prim, its extents in metres, and its class. `list` groups the rows
of one author or source, `split` says what they may be used for: `train` (knowledge and weights were improved on the
errors), `calibration` (only the confidence is fitted) or `test` (only scores are looked at). READMEs beside the tables
describe the lists.
"""

import csv
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

from benchmarks.bare import bare_object
from benchmarks.labelled_scenes import SHARED
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import SceneObject

__all__ = [
    "AUTHORS",
    "HOME_TABLE",
    "ONTOLOGY_TABLE",
    "PUBLIC_ONTOLOGIES",
    "SHARED_ONTOLOGIES",
    "LabelledName",
    "NameList",
    "iter_ontology_lists",
    "ontology_path",
    "read_names",
    "resolve_home_lists",
    "resolve_list",
]

BENCHMARKS = Path(__file__).parents[1]
HOME_TABLE = BENCHMARKS / "names/names.csv"
"""Names labelled with SOMA-HOME."""
ONTOLOGY_TABLE = BENCHMARKS / "ontologies/names.csv"
"""Names labelled with other ontologies; read from here or `SHARED_ONTOLOGIES`."""
SHARED_ONTOLOGIES = SHARED / "ontologies/other"
PUBLIC_ONTOLOGIES = {
    "SOMA+DFL": "multiverse_soma_dfl/SOMA_DFL_module.owl",
    "DogOnt": "dogont/dogont.owl",
    "REC": "rec/rec.ttl",
    "CCO": "cco/ArtifactOntology.ttl",
}
"""Ontology → file below `SHARED_ONTOLOGIES`; these may not be redistributed."""
AUTHORS = "authors"
"""Source of names made up by the authors of this project; other sources are public repositories."""


class LabelledName(NamedTuple):
    """One row, its classes resolved in a TBox."""

    obj: SceneObject
    """An object at the origin with only name, parent and size."""
    target: ClassIRI
    accepted: frozenset[ClassIRI]
    """The target and the other classes that a careful person would accept."""
    second: "LabelledName | None" = None
    """The same object as a second annotator labelled it, blind to the first label."""


class NameList(NamedTuple):
    """The rows of one list with one ontology."""

    name: str
    ontology: str
    """Empty for the built-in home TBox."""
    split: str
    rows: tuple[dict[str, str], ...]


@cache
def read_names(table: Path) -> tuple[NameList, ...]:
    """Return the lists of a table in its order."""
    grouped: dict[tuple[str, str, str], list[dict[str, str]]] = {}
    with table.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            ontology = row.get("ontology", "")
            # Lists with a public ontology are samples of many lists: merge them by split.
            name = ontology if ontology in PUBLIC_ONTOLOGIES else row["list"]
            grouped.setdefault((name, ontology, row["split"]), []).append(row)
    return tuple(NameList(*key, tuple(rows)) for key, rows in grouped.items())


def resolve_list(names: NameList, tbox: TBox) -> list[LabelledName]:
    """Return the labelled names of a list.

    Raises:
        OntologyError: a class is not in the TBox.
    """
    return [_resolve_row(row, tbox) for row in names.rows]


def resolve_home_lists(split: str, tbox: TBox) -> Iterator[list[LabelledName]]:
    """Yield each list of one split that is labelled with SOMA-HOME."""
    for names in read_names(HOME_TABLE):
        if names.split == split:
            yield resolve_list(names, tbox)


def iter_ontology_lists(splits: Sequence[str], *, public: bool | None = None) -> Iterator[tuple[NameList, TBox]]:
    """Yield the lists of some splits with their TBoxes, without those whose ontology is missing.

    Args:
        splits: the splits to yield.
        public: True for public ontologies only, False for those written for the benchmark only, None for both.
    """
    for names in read_names(ONTOLOGY_TABLE):
        is_public = names.ontology in PUBLIC_ONTOLOGIES
        if names.split in splits and public in (None, is_public) and ontology_path(names.ontology).exists():
            yield names, open_tbox(ontology_path(names.ontology))


def ontology_path(name: str) -> Path:
    """Return the file of an ontology of `ONTOLOGY_TABLE`, which may be absent."""
    if name in PUBLIC_ONTOLOGIES:
        return SHARED_ONTOLOGIES / PUBLIC_ONTOLOGIES[name]
    return ONTOLOGY_TABLE.with_name(f"{name}.ttl")


def _resolve_row(row: dict[str, str], tbox: TBox) -> LabelledName:
    size = (float(row["long_m"]), float(row["middle_m"]), float(row["short_m"]))
    obj = bare_object(f"/World/{row['parent']}/{row['name']}", size)
    first = LabelledName(obj, *_resolve_classes(row["class"], row["also"], tbox))
    if not row["second_class"]:
        return first
    return first._replace(second=LabelledName(obj, *_resolve_classes(row["second_class"], row["second_also"], tbox)))


def _resolve_classes(target: str, also: str, tbox: TBox) -> tuple[ClassIRI, frozenset[ClassIRI]]:
    iri = tbox.resolve(target)
    return iri, frozenset([iri, *(tbox.resolve(name) for name in also.split("|") if name)])
