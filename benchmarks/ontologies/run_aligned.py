"""Measure what an alignment by a language model adds, with recorded answers.

Usage: python -m benchmarks.ontologies.run_aligned

`members/ONTOLOGY.json` has what a language model answered when it was asked, once per ontology and without any name of
a list, what belongs to each class. Prints exact match and accepted answers in % with 95 % intervals (Wilson), with the
alignment that is built and with the model's; `conf.` is the mean stated probability of an exact answer in %, with the
model's.
"""

import json
from pathlib import Path

from benchmarks.names.lists import NameList, iter_ontology_lists, resolve_list
from benchmarks.names.scores import Tally, tally_answers
from usd2kg.grounding.lexical.alignment.alignment_file import AlignmentFile
from usd2kg.grounding.lexical.alignment.member_rows import rows_of_members
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.llm.class_members import ask_members, plan_questions
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.metered_client import MeteredClient
from usd2kg.ontology import TBox

MEMBERS = Path(__file__).parent / "members"
SPLITS = ("train", "test", "calibration")


class RecordedModel:
    """A model that answers from a file: class name → nouns."""

    def __init__(self, path: Path) -> None:
        recording = json.loads(path.read_text("utf-8"))
        self.model: str = recording["model"]
        self._answers: dict[str, object] = recording["classes"]

    def complete(self, request: Request) -> Completion:
        """Return the recorded rows of the classes that a prompt asks about."""
        asked = (line.split(". ", 1) for line in request.user.splitlines() if line[:1].isdigit())
        return Completion(json.dumps({number: self._answers[name] for number, name in asked if name in self._answers}))


def align(tbox: TBox, path: Path) -> LexicalGrounder:
    """Return a grounder with the alignment of a recorded model, written and read as a file."""
    model = RecordedModel(path)
    members, _ = ask_members(MeteredClient(model), plan_questions(tbox), workers=1)
    rows = rows_of_members(members, model.model, tbox, load_taxonomy())
    text = LexicalGrounder().format_alignment(tbox, rows)
    return LexicalGrounder(alignment=AlignmentFile(path.with_suffix(".sssom.tsv"), text))


def main() -> None:
    """Measure and print."""
    shares = f"{'exact':<17}  {'accepted':<17}"
    print(f"{'list':<24}{'split':<12}{'n':>5}  {'built: ' + shares:<43}{'with the model: ' + shares}conf.")
    totals: dict[str, tuple[Tally, Tally]] = {}
    for names, tbox in iter_ontology_lists(SPLITS, public=False):
        path = MEMBERS / f"{names.ontology}.json"
        if path.exists():
            built, aligned = totals.get(names.split, (Tally(), Tally()))
            found = print_list(names, tbox, path)
            totals[names.split] = built.plus(found[0]), aligned.plus(found[1])
    for split, (built, aligned) in totals.items():
        print_row("all", split, built, aligned)


def print_list(names: NameList, tbox: TBox, path: Path) -> tuple[Tally, Tally]:
    """Print and return the scores of one list with the alignment that is built and with the model's."""
    resolved = resolve_list(names, tbox)
    built, aligned = tally_answers(resolved, tbox), tally_answers(resolved, tbox, grounder=align(tbox, path))
    print_row(names.name, names.split, built, aligned)
    return built, aligned


def print_row(name: str, split: str, built: Tally, aligned: Tally) -> None:
    """Print the scores of one list, or of all."""
    confidence = 100 * aligned.confidence / aligned.count
    print(f"{name:<24}{split:<12}{built.count:>5}  {built!s:<43}{aligned!s:<43}{confidence:5.0f}", flush=True)


if __name__ == "__main__":
    main()
