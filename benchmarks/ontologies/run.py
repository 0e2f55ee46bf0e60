"""Measure accuracy on names alone with ontologies other than SOMA-HOME.

Usage: python -m benchmarks.ontologies.run

Prints exact match and accepted answers in % with 95 % intervals (Wilson), by list and by split. `conf.` is the mean
stated probability of an exact answer in %: above the exact share the grounder is overconfident. The columns from `below
a root` exclude objects whose target is a root class. README.md describes the lists.
"""

from benchmarks.names.lists import (
    ONTOLOGY_TABLE,
    PUBLIC_ONTOLOGIES,
    LabelledName,
    NameList,
    iter_ontology_lists,
    ontology_path,
    read_names,
    resolve_list,
)
from benchmarks.names.scores import Tally, second_annotator_lines, tally_answers
from usd2kg.ontology import TBox

SPLITS = ("train", "test", "calibration")


def main() -> None:
    """Measure and print."""
    shares = f"{'exact':<17}  {'accepted':<17}"
    print(f"{'list':<24}{'split':<12}{'n':>5}  {shares}  conf.  below a root  {shares}".rstrip())
    for public in (False, True):
        totals: dict[str, Tally] = {}
        for names, tbox in iter_ontology_lists(SPLITS, public=public):
            tally = print_list(names, resolve_list(names, tbox), tbox)
            totals[names.split] = totals.get(names.split, Tally()).plus(tally)
        for split, total in totals.items():
            print(f"{'public ontologies' if public else 'own ontologies':<24}{split:<12}{total.count:>5}  {total}")
    for ontology in PUBLIC_ONTOLOGIES:
        if not ontology_path(ontology).exists():
            print(f"not measured: {ontology}, {ontology_path(ontology)} is missing")
    print_second_annotators()


def print_list(names: NameList, resolved: list[LabelledName], tbox: TBox) -> Tally:
    """Print the scores of one list and return those of all its names."""
    below = [name for name in resolved if name.target not in tbox.roots]
    tally, tally_below = tally_answers(resolved, tbox), tally_answers(below, tbox)
    confidence = f"{100 * tally.confidence / tally.count:5.0f}"
    row = f"{names.name:<24}{names.split:<12}{tally.count:>5}  {tally}  {confidence}  {tally_below.count:>12}"
    print(f"{row}  {tally_below}", flush=True)
    return tally


def print_second_annotators() -> None:
    """Print the agreement on each list that two annotators labelled."""
    twice = {(names.name, names.split) for names in read_names(ONTOLOGY_TABLE) if has_second_labels(names)}
    for names, tbox in iter_ontology_lists(("test",)):
        if (names.name, names.split) in twice:
            print(f"\n{names.name}, {names.split}")
            print("\n".join(second_annotator_lines(resolve_list(names, tbox), tbox)))


def has_second_labels(names: NameList) -> bool:
    """Return whether a second annotator labelled the list."""
    return any(row["second_class"] for row in names.rows)


if __name__ == "__main__":
    main()
