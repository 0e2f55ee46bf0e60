"""Accuracy with ontologies that usd2kg was not made for, on names alone.

Usage: python -m benchmarks.ontologies.run

Fourteen ontologies were written for this benchmark, each by an author who knew nothing of usd2kg's vocabulary, as
engineers of the field would: `ward` (a hospital), `street` (outdoors in a town, bare IRIs), `canteen` (professional
kitchens), `school` (most classes without a label), `hotel` (bare IRIs), `depot` (logistics), `store` (a supermarket,
numbers for IRIs), `works` (a factory), `farm` (labels in two languages), `airport` and `garage` (numbers for IRIs),
`theatre`, `laboratory` and `site` (a building site, labels in two languages). With each comes a list of 200 or 220
things as artists call them, labelled blind: a third of them everyday, a third of the field, a third for which there is
a general class only. The errors of the first six were learned from; of the others only the score was looked at, and
those of the last two set the confidence, which lists that were learned from would set too high.

Names that people gave stand in seven more lists: of prims, nodes and models in public repositories, which `source`
names, labelled blind with four of these ontologies; the sizes are estimates. `outdoors`, `bedside` and `factory` were
learned from, `outside`, `clinic` and `shopfloor`, parted from them by lot, and `aisles` are tests, which
`second_found.csv` has another labeller's classes for. With `factory` the ontology `works` was seen, too.

`labels.csv` has what 440 things of `benchmarks/names` are in four public ontologies, labelled blind too, half of them
to learn from and half a test (from the lists that are tests); `second_labels.csv` what another labeller calls them with
SOMA+DFL. They are measured where `../shared/ontologies` is.

The confidence is that of being exactly right, on average; where it is higher than the share that is, it says too much.
The last columns leave out the things for which an ontology has nothing better than one of its roots.
"""

import csv
from collections.abc import Iterator
from operator import itemgetter
from pathlib import Path

from benchmarks.names.run import HERE as NAMES
from benchmarks.names.run import (
    TEST,
    TRAIN,
    Thing,
    agreement,
    labels_of,
    load,
    measure,
    told_by_two,
    twice_labelled,
)
from usd2kg.grounding import NamingRegime
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox

HERE = Path(__file__).parent
OWN = {
    **dict.fromkeys(["ward", "street", "canteen", "school", "hotel", "depot"], "train"),
    **dict.fromkeys(["store", "works", "farm", "airport", "garage", "theatre"], "test"),
    **dict.fromkeys(["laboratory", "site"], "sure"),
}
FOUND = {
    "outdoors": ("street", "train"),
    "outside": ("street", "test"),
    "bedside": ("ward", "train"),
    "clinic": ("ward", "test"),
    "factory": ("works", "train"),
    "shopfloor": ("works", "test"),
    "aisles": ("store", "test"),
}
"""List of names from public repositories → the ontology that they are labelled with, and split."""
ONTOLOGIES = HERE.parents[2] / "shared/ontologies/other"
PUBLIC = {
    "SOMA+DFL": "multiverse_soma_dfl/SOMA_DFL_module.owl",
    "DogOnt": "dogont/dogont.owl",
    "REC": "rec/rec.ttl",
    "CCO": "cco/ArtifactOntology.ttl",
}


def main() -> None:
    """Measure and print."""
    print("ontology  split  n    exact (also)  confidence  below a root: n, exact (also)")
    for name, (ontology, split) in lists().items():
        tbox = open_tbox(HERE / f"{ontology}.ttl")
        report(name, split, load(HERE / f"{name}.csv", tbox), tbox)
    for name, (ontology, split) in FOUND.items():
        if split == "test":
            tbox = open_tbox(HERE / f"{ontology}.ttl")
            print(f"\n{name}: {told_by_two(*twice_labelled(HERE, 'second_found.csv', [name], tbox), tbox)}")
    if not ONTOLOGIES.is_dir():
        print(f"\npublic ontologies: not measured, {ONTOLOGIES} is missing")
        return
    for name, path in PUBLIC.items():
        tbox = open_tbox(ONTOLOGIES / path)
        for split in ("train", "test"):
            report(name, split, labelled(name, split, tbox), tbox)
    tbox = open_tbox(ONTOLOGIES / PUBLIC["SOMA+DFL"])
    firsts, seconds = (labelled("SOMA+DFL", "test", tbox, file) for file in ("labels.csv", "second_labels.csv"))
    exact, also = agreement(firsts, seconds)
    print(f"\nSOMA+DFL, test: a second labeller against the first {exact:.1f} ({also:.1f});")
    print(f"the grounder against the second {measure(seconds, tbox, NamingRegime.SEMANTIC)}")


def lists() -> dict[str, tuple[str, str]]:
    """Return list → (ontology, split) of the lists with ontologies that were written for this benchmark."""
    return {name: (name, split) for name, split in OWN.items()} | FOUND


def report(ontology: str, split: str, things: list[Thing], tbox: TBox) -> None:
    """Print one row."""
    below = [thing for thing in things if thing.target not in tbox.roots]
    for_all, for_below = (measure(group, tbox, NamingRegime.SEMANTIC) for group in (things, below))
    says = f"{for_all.confidence:.0f}"
    print(f"{ontology:<9} {split:<6} {len(things)}  {for_all}   {says:<11} {len(below)}, {for_below}")


def to_learn_from() -> Iterator[tuple[list[Thing], TBox]]:
    """Yield the lists that the knowledge and the weights were learned from, with the ontologies that are there."""
    yield from _of_split("train")
    yield from public_to_learn_from()


def to_be_sure_by() -> Iterator[tuple[list[Thing], TBox]]:
    """Yield the lists that nothing was learned from and that are no tests: they tell how sure to be."""
    yield from _of_split("sure")


def _of_split(wanted: str) -> Iterator[tuple[list[Thing], TBox]]:
    for name, (ontology, split) in lists().items():
        if split == wanted:
            tbox = open_tbox(HERE / f"{ontology}.ttl")
            yield load(HERE / f"{name}.csv", tbox), tbox


def public_to_learn_from() -> Iterator[tuple[list[Thing], TBox]]:
    """Yield the lists with public ontologies that are no tests, of the ontologies that are there."""
    for name, path in PUBLIC.items() if ONTOLOGIES.is_dir() else ():
        tbox = open_tbox(ONTOLOGIES / path)
        yield labelled(name, "train", tbox), tbox


def labelled(ontology: str, split: str, tbox: TBox, file_name: str = "labels.csv") -> list[Thing]:
    """Return the things of the lists of names that are labelled with a public ontology."""
    home = open_tbox(None)
    objects = {
        (name, found.obj.name, found.obj.prim_path.split("/")[-2]): found.obj
        for name in (*TRAIN, *TEST)
        for found in load(NAMES / f"{name}.csv", home)
    }
    with (HERE / file_name).open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if (row["ontology"], row["split"]) == (ontology, split)]
    rows.sort(key=itemgetter("list", "name", "parent"))
    return [Thing(objects[row["list"], row["name"], row["parent"]], *labels_of(row, tbox)) for row in rows]


if __name__ == "__main__":
    main()
