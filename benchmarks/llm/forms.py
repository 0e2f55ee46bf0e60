"""Measure cost and accuracy of prompt forms with one model on one scene, and the effect of class order and batch size.

Usage: python -m benchmarks.llm.forms MODEL SCENE GOLD [FORM …] [--every N] [--completions FOLDER]

MODEL is a model string such as `gguf:FILE` or `openai:NAME@URL`. All forms ask about the same labelled objects. Prints
a Markdown table: input tokens per object, cached ones among them, seconds per object, exact match with a 95 % interval,
accepted answers, hierarchical F1, and the number of objects with another class than in the first form. Completions are
stored in one file per form; an interrupted run resumes, and its tokens and seconds then cover the remaining prompts.
"""

import argparse
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from usd2kg.evaluation.gold import GoldLabel, read_gold
from usd2kg.evaluation.run import score_grounding
from usd2kg.evaluation.summary import Summary
from usd2kg.grounding import ground, make_grounder
from usd2kg.grounding.llm.factory import LLMSettings, open_llm_grounder
from usd2kg.grounding.llm.prompt_options import Strategy
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox
from usd2kg.scene import Scene, read_scene

PLAIN = "B"
FORMS: Mapping[str, LLMSettings] = {
    PLAIN: LLMSettings(""),
    "A": LLMSettings("", strategy=Strategy.NAME_ONLY),
    "C": LLMSettings("", strategy=Strategy.CHAIN_OF_THOUGHT),
    "B, each object": LLMSettings("", is_each_object=True),
    "B, tree": LLMSettings("", is_tree=True),
    "B, shuffled 1": LLMSettings("", shuffle_seed=1),
    "B, shuffled 2": LLMSettings("", shuffle_seed=2),
    "B, shuffled 3": LLMSettings("", shuffle_seed=3),
    "B, 5 a prompt": LLMSettings("", objects_per_prompt=5),
    "B, 20 a prompt": LLMSettings("", objects_per_prompt=20),
    "B, shortlist of 8": LLMSettings("", shortlist=8),
    "A, shortlist of 8": LLMSettings("", strategy=Strategy.NAME_ONLY, shortlist=8),
}
"""Prompt forms; the first is the reference for the others."""


@dataclass(frozen=True)
class Task:
    """The labelled objects of a scene."""

    scene: Scene
    gold: Sequence[GoldLabel]
    tbox: TBox

    @property
    def paths(self) -> list[str]:
        """The labelled prims."""
        return [label.prim_path for label in self.gold]


@dataclass(frozen=True)
class Outcome:
    """The result of one form."""

    name: str
    summary: Summary
    classes: Mapping[str, ClassIRI | None]
    tokens: float
    kept: float
    seconds: float


def main() -> None:
    """Print a row for each form when it is done."""
    options = parse_options()
    tbox = load_home_tbox()
    gold = read_gold(options.gold, tbox)[:: options.every]
    task = Task(read_scene(options.scene, paths=[label.prim_path for label in gold]), gold, tbox)
    print(f"{len(gold)} objects of {options.scene.name}, {len(tbox.classes)} classes\n")
    print(
        "| form | tokens per object | cached | seconds per object | exact % (95 %) | accepted % | HF1 | other class |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    plain: Outcome | None = None
    for outcome in outcomes(task, options):
        plain = plain or outcome
        print(row_of(outcome, plain), flush=True)


def parse_options() -> argparse.Namespace:
    """Return the command-line options."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("model")
    parser.add_argument("scene", type=Path)
    parser.add_argument("gold", type=Path)
    parser.add_argument("forms", nargs="*", metavar="FORM", help=f"of: {'; '.join(FORMS)}; default: all")
    parser.add_argument("--every", type=int, default=1, help="take every Nth labelled object")
    parser.add_argument("--completions", type=Path, default=Path("build/forms"))
    return parser.parse_args()


def outcomes(task: Task, options: argparse.Namespace) -> Iterator[Outcome]:
    """Yield the result of each form, then that of the default grounder, which uses no model."""
    options.completions.mkdir(parents=True, exist_ok=True)
    for name in options.forms or FORMS:
        settings = replace(FORMS[name], model=options.model, completions=options.completions / f"{slug(name)}.sqlite")
        yield ask(name, task, settings)
    start = time.perf_counter()
    grounding = ground(task.scene, task.tbox, make_grounder("lexical"), paths=task.paths)
    seconds = time.perf_counter() - start
    scored = score_grounding(grounding, task.gold, task.tbox, seconds)
    classes = {p.prim_path: p.class_iri for p in grounding.predictions}
    yield Outcome("no model", scored.summary, classes, 0, 0, seconds / len(task.gold))


def ask(name: str, task: Task, settings: LLMSettings) -> Outcome:
    """Return the result of one form."""
    with open_llm_grounder(settings) as grounder:
        grounding = ground(task.scene, task.tbox, grounder, paths=task.paths)
        usage, seconds = grounder.report.usage, grounder.report.seconds
    count = len(task.gold)
    scored = score_grounding(grounding, task.gold, task.tbox, seconds)
    classes = {p.prim_path: p.class_iri for p in grounding.predictions}
    return Outcome(
        name, scored.summary, classes, usage.input_tokens / count, usage.cached_tokens / count, seconds / count
    )


def slug(name: str) -> str:
    """Return the name of a form as a file name.

    >>> slug("B, each object")
    'B-each-object'
    """
    return "-".join(name.replace(",", " ").split())


def row_of(outcome: Outcome, plain: Outcome) -> str:
    """Return a table row."""
    summary, interval = outcome.summary, outcome.summary.ema_interval
    others = sum(1 for path, iri in outcome.classes.items() if plain.classes.get(path) != iri)
    return (
        f"| {outcome.name} | {outcome.tokens:,.0f} | {outcome.kept:,.0f} | {outcome.seconds:.1f} "
        f"| {summary.ema:.0f} ({interval.lower:.0f}–{interval.upper:.0f}) | {summary.ema_also:.0f} "
        f"| {summary.hf1:.2f} | {others} |"
    )


if __name__ == "__main__":
    main()
