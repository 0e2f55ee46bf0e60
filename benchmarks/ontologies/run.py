"""Measure accuracy on names alone with ontologies other than SOMA-HOME.

Usage: python -m benchmarks.ontologies.run

Prints exact match and accepted answers in % with 95 % intervals (Wilson), by list and by split. `conf.` is the mean
stated probability of an exact answer in %: above the exact share the grounder is overconfident. The columns from `below
a root` exclude objects whose target is a root class. Public ontologies are measured with the lists of what belongs to
their classes that usd2kg ships (`knowledge/class_members.csv`), and without. README.md describes the lists of names.
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
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import TBox

SPLITS = ("train", "test", "calibration")


def main() -> None:
    """Measure and print."""
    shares = f"{'exact':<17}  {'accepted':<17}"
    print(f"{'list':<24}{'split':<12}{'n':>5}  {shares}  conf.  below a root  {shares}".rstrip())
    for title, is_public, grounder in (
        ("own ontologies", False, LexicalGrounder()),
        ("public ontologies", True, LexicalGrounder()),
        ("without shipped lists", True, LexicalGrounder(use_member_lists=False)),
    ):
        print(title)
        totals: dict[str, Tally] = {}
        for names, tbox in iter_ontology_lists(SPLITS, public=is_public):
            tally = print_list(names, resolve_list(names, tbox), tbox, grounder)
            totals[names.split] = totals.get(names.split, Tally()).plus(tally)
        for split, total in totals.items():
            print(f"{'all':<24}{split:<12}{total.count:>5}  {total}  {_mean_confidence(total)}")
    for ontology in PUBLIC_ONTOLOGIES:
        if not ontology_path(ontology).exists():
            print(f"not measured: {ontology}, {ontology_path(ontology)} is missing")
    print_second_annotators()


def print_list(names: NameList, resolved: list[LabelledName], tbox: TBox, grounder: LexicalGrounder) -> Tally:
    """Print the scores of one list and return those of all its names."""
    below = [name for name in resolved if name.target not in tbox.roots]
    tally, tally_below = (tally_answers(some, tbox, grounder=grounder) for some in (resolved, below))
    row = f"{names.name:<24}{names.split:<12}{tally.count:>5}  {tally}  {_mean_confidence(tally)}"
    print(f"{row}  {tally_below.count:>12}  {tally_below}", flush=True)
    return tally


def _mean_confidence(tally: Tally) -> str:
    return f"{100 * tally.confidence / tally.count:5.0f}"


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
