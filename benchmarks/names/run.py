"""Measure accuracy on names alone: lists of objects with name, parent, size and SOMA-HOME class.

Usage: python -m benchmarks.names.run [ONTOLOGY]

Prints exact match and accepted answers in % with 95 % intervals (Wilson), by list and by split, for authored and
abbreviated names. Without an ontology the built-in home TBox is used. README.md describes the lists.
"""

import sys
from pathlib import Path

from benchmarks.names.lists import HOME_TABLE, LabelledName, read_names, resolve_list
from benchmarks.names.scores import Tally, second_annotator_lines, tally_answers
from usd2kg.grounding import NamingRegime
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox

REGIMES = (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED)
HEADER = f"{'exact':<17}  {'accepted':<17}"


def main() -> None:
    """Measure and print."""
    tbox = open_tbox(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
    print(f"{'':<49}" + "   ".join(f"{regime.value:<36}" for regime in REGIMES).rstrip())
    print(f"{'list':<36}{'split':<6}{'n':>5}  " + "   ".join([HEADER] * len(REGIMES)))
    totals: dict[str, list[Tally]] = {}
    for names in read_names(HOME_TABLE):
        resolved = resolve_list(names, tbox)
        tallies = [tally_answers(resolved, tbox, regime) for regime in REGIMES]
        print_row(names.name, names.split, tallies)
        sums = totals.setdefault(names.split, [Tally()] * len(REGIMES))
        totals[names.split] = [total.plus(tally) for total, tally in zip(sums, tallies, strict=True)]
    for split, tallies in totals.items():
        print_row("all", split, tallies)
    print_second_annotators(tbox)


def print_row(name: str, split: str, tallies: list[Tally]) -> None:
    """Print the scores of one list or split."""
    print(f"{name:<36}{split:<6}{tallies[0].count:>5}  " + "   ".join(map(str, tallies)), flush=True)


def print_second_annotators(tbox: TBox) -> None:
    """Print the agreement of two annotators, by kind of source."""
    groups: dict[bool, list[LabelledName]] = {}
    for names in read_names(HOME_TABLE):
        twice = [name for name in resolve_list(names, tbox) if name.second]
        groups.setdefault("-public-" in names.name, []).extend(twice)
    for is_public, names_of_group in groups.items():
        print("\nNames from public repositories" if is_public else "\nNames by the authors")
        print("\n".join(second_annotator_lines(names_of_group, tbox)))


if __name__ == "__main__":
    main()
