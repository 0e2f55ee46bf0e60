"""Measure the built-in TBox of places on names of objects alone, and the choice between it and that of homes.

Usage: python -m benchmarks.places.run

Prints exact match and accepted answers in % with 95 % intervals (Wilson), the mean stated confidence, and which TBox
the names of each place choose. README.md describes the names.
"""

import csv
from collections import defaultdict
from pathlib import Path

from benchmarks.bare import bare_object
from benchmarks.names.lists import LabelledName
from benchmarks.names.scores import Tally, tally_answers
from usd2kg.grounding.built_in_choice import count_place_votes
from usd2kg.ontology import TBox, load_places_tbox

NAMES = Path(__file__).with_name("names.csv")


def read_places(tbox: TBox) -> dict[str, list[LabelledName]]:
    """Return the labelled names of each place."""
    places = defaultdict(list)
    with NAMES.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            target = tbox.resolve(row["class"])
            accepted = frozenset([target, *(tbox.resolve(name) for name in row["also"].split("|") if name)])
            obj = bare_object(f"/World/{row['place']}/{row['name']}")
            places[row["place"]].append(LabelledName(obj, target, accepted))
    return places


def main() -> None:
    """Measure and print."""
    tbox = load_places_tbox()
    print(f"{'place':<12}{'n':>4}  {'exact':<17}  {'accepted':<17}  conf.  TBox chosen")
    total = Tally()
    for place, names in read_places(tbox).items():
        tally = tally_answers(names, tbox)
        votes = count_place_votes(name.obj.name for name in names)
        understood = len(votes.workplaces) + votes.homes
        chosen = f"{'places' if votes.is_workplace else 'home'} ({len(votes.workplaces)} of {understood} names)"
        print(f"{_row(place, tally)}  {chosen}")
        total = total.plus(tally)
    print(_row("all", total))


def _row(title: str, tally: Tally) -> str:
    return f"{title:<12}{tally.count:>4}  {tally}  {100 * tally.confidence / tally.count:5.0f}"


if __name__ == "__main__":
    main()
