"""Measure the form of the prompt: tokens, seconds, and accuracy of a model on labelled objects.

Usage: python -m benchmarks.llm.forms [MODEL …] [--forms FORM …] [--scenes NAME …] [--objects N] [--record FILE]

Asks about N evenly spaced labels of each scene, adds the answers about each scene to the record, and prints a table of
everything in the record. What it holds already is not asked again, so an interrupted run resumes. Without a MODEL, only
the table is printed.
"""

import argparse
import json
import math
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from benchmarks.labelled_scenes import LabelledScene, load_scene, read_accuracy_matrix
from benchmarks.llm.forms_table import Outcome, print_table
from usd2kg.grounding import ground, make_grounder
from usd2kg.grounding.llm.factory import LLMSettings, open_llm_grounder
from usd2kg.grounding.llm.few_shot_choice import choose_examples
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.prompt_options import Strategy
from usd2kg.grounding.llm.prompts import Example

SCENES = ("Franka kitchen", "AWS small house", "Demo kitchen")
NO_MODEL = "default grounder"


@dataclass(frozen=True)
class Form:
    """A form of the prompt."""

    settings: LLMSettings
    base: str
    """The form that its answers are compared to."""
    examples: int = 0
    """Labelled objects of the other scenes that the prompt shows."""


_A = LLMSettings("", strategy=Strategy.NAME_ONLY)
_SHORT_A = replace(_A, shortlist=8)
_B = LLMSettings("")
FORMS: Mapping[str, Form] = {
    "A, shortlist of 8": Form(_SHORT_A, "A, shortlist of 8"),
    "… shuffled 1": Form(replace(_SHORT_A, shuffle_seed=1), "A, shortlist of 8"),
    "… shuffled 2": Form(replace(_SHORT_A, shuffle_seed=2), "A, shortlist of 8"),
    "… candidates first": Form(replace(_SHORT_A, has_candidates_first=True), "A, shortlist of 8"),
    "… as a tree": Form(replace(_SHORT_A, is_tree=True), "A, shortlist of 8"),
    "… with 8 examples": Form(_SHORT_A, "A, shortlist of 8", examples=8),
    "… 5 samples": Form(replace(_SHORT_A, samples=5), "A, shortlist of 8"),
    "B, shortlist of 8": Form(replace(_B, shortlist=8), "A, shortlist of 8"),
    "C, shortlist of 8": Form(replace(_B, strategy=Strategy.CHAIN_OF_THOUGHT, shortlist=8), "A, shortlist of 8"),
    "concept, shortlist of 8": Form(replace(_B, strategy=Strategy.BY_CONCEPT, shortlist=8), "B, shortlist of 8"),
    "A, all classes": Form(_A, "A, shortlist of 8"),
    "A, all classes, shuffled 1": Form(replace(_A, shuffle_seed=1), "A, all classes"),
    "A, all classes, tree": Form(replace(_A, is_tree=True), "A, all classes"),
    "A, all classes, shuffled 2": Form(replace(_A, shuffle_seed=2), "A, all classes"),
    "B, all classes": Form(_B, "A, all classes"),
    "B, all classes, 5 a prompt": Form(replace(_B, objects_per_prompt=5), "B, all classes"),
}


def main() -> None:
    """Ask about what the record lacks, and print it."""
    options = parse_options()
    specs = {spec.name: spec for spec in read_accuracy_matrix().scenes}
    scenes = [load_scene(specs[name]) for name in options.scenes]
    record = Record(options.record)
    for scene in scenes:
        if not record.has(NO_MODEL, "", scene.name):
            record.add(ask_default_grounder(scene, options.objects))
    for model in options.models:
        for form in options.forms or FORMS:
            for outcome in ask_form(model, form, scenes, record, options):
                record.add(outcome)
    print_table(record.outcomes, scenes, {name: form.base for name, form in FORMS.items()})


def parse_options() -> argparse.Namespace:
    """Return the command-line options."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("models", nargs="*", metavar="MODEL")
    parser.add_argument("--forms", nargs="*", choices=FORMS, metavar="FORM", help=f"of: {'; '.join(FORMS)}")
    parser.add_argument("--scenes", nargs="*", default=SCENES, metavar="NAME", help="names in accuracy/matrix.toml")
    parser.add_argument("--objects", type=int, default=7, help="evenly spaced labels of each scene")
    parser.add_argument("--listed-objects", type=int, help="how many of these in forms with all classes; default: all")
    parser.add_argument("--record", type=Path, default=Path(__file__).with_name("forms.jsonl"))
    return parser.parse_args()


class Record:
    """The outcomes of all runs, in a file of JSON lines."""

    def __init__(self, path: Path) -> None:
        self._path = path
        lines = path.read_text().splitlines() if path.exists() else []
        self.outcomes = [Outcome(**json.loads(line)) for line in lines]

    def has(self, model: str, form: str, scene: str) -> bool:
        """Return whether the answers of a model about a scene are recorded."""
        return any((one.model, one.form, one.scene) == (model, form, scene) for one in self.outcomes)

    def add(self, outcome: Outcome) -> None:
        """Append an outcome."""
        self.outcomes.append(outcome)
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with self._path.open("a") as file:
            file.write(json.dumps(asdict(outcome)) + "\n")


def ask_default_grounder(scene: LabelledScene, count: int) -> Outcome:
    """Return the answers of the default grounder, which uses no model."""
    start = time.process_time()
    paths = spaced(scene.paths, count)
    answers = ground(scene.scene, scene.tbox, make_grounder("lexical"), paths=paths).by_path
    seconds = time.process_time() - start
    return Outcome(NO_MODEL, "", scene.name, 0, 0, 0, seconds, {path: answers[path].class_iri for path in paths})


def ask_form(
    model: str, name: str, scenes: Sequence[LabelledScene], record: Record, options: argparse.Namespace
) -> Iterator[Outcome]:
    """Yield the answers of a model to a form of the prompt, for each scene that the record lacks."""
    form = FORMS[name]
    label = Path(model.removeprefix("gguf:")).name
    missing = [scene for scene in scenes if not record.has(label, name, scene.name)]
    completions = options.record.with_suffix(".sqlite")
    completions.parent.mkdir(parents=True, exist_ok=True)
    settings = replace(form.settings, model=model, completions=completions)
    # Scenes with the same system prompt share the model's cache; with examples, each has its own.
    for group in [[scene] for scene in missing] if form.examples else [missing]:
        examples = examples_for(group[0], scenes, form.examples) if form.examples else []
        with open_llm_grounder(settings, examples=examples) as grounder:
            for scene in group:
                paths = spaced(scene.paths, options.objects)
                few = options.listed_objects if form.settings.shortlist is None else None
                yield ask(grounder, label, name, scene, spaced(paths, few or len(paths)))


def ask(grounder: LLMGrounder, model: str, form: str, scene: LabelledScene, paths: Sequence[str]) -> Outcome:
    """Return the answers about objects of a scene. The time is that of the processor, for models in this process."""
    grounder.restart_report()
    start = time.process_time()
    answers = ground(scene.scene, scene.tbox, grounder, paths=paths).by_path
    report = grounder.report
    usage = report.usage + report.cached_usage
    # Another form with the same prompts, or an interrupted run, may have stored completions, which take no time here.
    share = report.completions / max(1, report.completions + report.cached)
    return Outcome(
        model,
        form,
        scene.name,
        usage.input_tokens,
        usage.cached_tokens,
        usage.output_tokens,
        (time.process_time() - start) / share if share else math.nan,
        {path: answers[path].class_iri for path in paths},
    )


def examples_for(scene: LabelledScene, scenes: Sequence[LabelledScene], count: int) -> list[Example]:
    """Return labelled objects of the other scenes, as many of each as fit."""
    others = [other for other in scenes if other.name != scene.name]
    decisions = [{label.prim_path: label.target for label in other.gold} for other in others]
    pairs = zip(others, decisions, strict=True)
    chosen = [one for other, known in pairs for one in choose_examples(other.scene, known, count // len(others))]
    return [one for one in chosen if one.class_iri in scene.tbox.by_iri]


def spaced(paths: Sequence[str], count: int) -> list[str]:
    """Return at most `count` evenly spaced paths.

    >>> spaced(["a", "b", "c", "d", "e"], 2)
    ['a', 'c']
    """
    return list(paths[:: max(1, len(paths) // count)][:count])


if __name__ == "__main__":
    main()
