"""Measure tokens and agreement of one question per concept against one prompt per object, with a scripted model.

Usage: python -m benchmarks.llm.concepts [COUNT …] [--cascade CONFIDENCE] [--scenes]

Without `--scenes`, prints the input and output tokens per object of five ways to ask about synthetic rooms of COUNT
objects (default: 100, 1,000 and 10,000): strategy B with one prompt per object, as in the study; B as shipped; one
question per concept; that only where the lexical grounder is unsure; and with a shortlist of classes. Tokens are
estimated at four bytes each.

A room draws nouns of homes, which the lexical grounder knows, and of workplaces, a quarter, for which the home TBox has
no class. It draws them by Zipf's law (the k-th noun with a frequency of 1/k), in a fixed random order, with colours,
numbers and prefixes of pipelines, so the number of distinct names grows with the room.

With `--scenes`, a scripted model that knows the gold class of each labelled name answers on all labelled scenes. It
loses exact matches only where a question groups objects of different classes: the answer is that of most of them.
"""

import argparse
import json
import random
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import NamedTuple

from benchmarks.labelled_scenes import LabelledScene, iter_training_scenes
from usd2kg.grounding import CascadeGrounder, Grounder, ObjectView, ground, make_grounder
from usd2kg.grounding.context.views import view_objects
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.llm.completion import Completion, Request, Usage
from usd2kg.grounding.llm.concept_groups import reading_of
from usd2kg.grounding.llm.estimates import estimate_input
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.metered_client import MeteredClient
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompt_text import estimate_tokens
from usd2kg.grounding.llm.settings import CONCEPTS
from usd2kg.knowledge import read_rows
from usd2kg.ontology import TBox, load_home_tbox

Views = Sequence[tuple[str, ObjectView]]

COLOURS = ("", "", "Red", "Blue", "White", "Old", "Small")
PREFIXES = ("", "", "SM_", "geo_")
ROOMS = ("Kitchen", "Bedroom", "Bathroom", "Hall", "Office")
SEED = 7
PER_CONCEPT = PromptOptions(strategy=Strategy.BY_CONCEPT, is_tree=True, objects_per_prompt=CONCEPTS.concepts_per_prompt)
STUDY = "B, one prompt per object"


class Way(NamedTuple):
    """A way to ask about objects."""

    name: str
    options: PromptOptions
    shares_answers: bool = True
    is_cascade: bool = False
    shortlist: int | None = None


WAYS = (
    Way(STUDY, PromptOptions(), shares_answers=False),
    Way("B, equal evidence once", PromptOptions()),
    Way("once per concept", PER_CONCEPT),
    Way("once per unsure concept", PER_CONCEPT, is_cascade=True),
    Way("… shortlist of 8", PER_CONCEPT, is_cascade=True, shortlist=8),
)


class ScriptedModel:
    """A model that answers each row with the class that most of the row's objects have."""

    model = "scripted:gold"

    def __init__(self, classes: Mapping[str, Counter[str]] | None = None) -> None:
        """Create a model; `classes` are the gold classes by the reading of a name, None for a model that knows none."""
        self._classes = classes or {}

    def complete(self, request: Request) -> Completion:
        """Return the answer, with estimated token counts."""
        rows = re.findall(r"^object (\d+)\n(.*?)(?=^object |^</objects>)", request.user, re.S | re.M)
        offered = next(iter(request.schema["properties"].values()))["properties"]["class"]["enum"]
        text = json.dumps({number: {"class": self._answer(row) or offered[0]} for number, row in rows})
        return Completion(text, usage=Usage(estimate_input(request), 0, estimate_tokens(text)))

    def _answer(self, row: str) -> str | None:
        line = re.search(r"^names?: (.*)$", row, re.M)
        votes: Counter[str] = Counter()
        for name, times in re.findall(r'("(?:[^"\\]|\\.)*")(?: \((\d+) times\))?', line[1] if line else ""):
            known = self._classes.get(reading_of(json.loads(name)), Counter())
            votes[known.most_common(1)[0][0] if known else ""] += int(times or 1)
        votes.pop("", None)
        return votes.most_common(1)[0][0] if votes else None


def main() -> None:
    """Print a table of tokens, or of exact matches."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("counts", nargs="*", type=int, metavar="COUNT", default=[100, 1_000, 10_000])
    parser.add_argument("--cascade", type=float, default=0.8, help="confidence below which the model is asked")
    parser.add_argument("--scenes", action="store_true", help="compare exact matches on the labelled scenes")
    options = parser.parse_args()
    if options.scenes:
        print("| scene | objects | way | prompts | tokens per object | exact % |")
        print("| --- | --- | --- | --- | --- | --- |")
        for scene in iter_training_scenes():
            for row in compare_answers(scene, options.cascade):
                print(row, flush=True)
        return
    print("| objects | way | prompts | input tokens per object | output tokens per object | share of the study's |")
    print("| --- | --- | --- | --- | --- | --- |")
    for count in options.counts:
        for row in compare_tokens(count, options.cascade):
            print(row, flush=True)


def compare_tokens(count: int, min_confidence: float) -> Iterator[str]:
    """Yield a row of the table for each way to ask about a synthetic room."""
    tbox, views = load_home_tbox(), list(synthetic_views(count))
    study = 0
    for way in WAYS:
        client = MeteredClient(ScriptedModel())
        make_way(way, client, min_confidence).ground_views(views, tbox)
        usage = client.report.usage
        total = usage.input_tokens + usage.output_tokens
        study = study or total
        share = "1" if total == study else f"1/{study / total:,.0f}"
        per_object = f"{usage.input_tokens / count:,.1f} | {usage.output_tokens / count:,.2f}"
        yield f"| {count:,} | {way.name} | {client.report.prompts:,} | {per_object} | {share} |"


def compare_answers(labelled: LabelledScene, min_confidence: float) -> Iterator[str]:
    """Yield a row of the table for each way to ask about a labelled scene."""
    views = {obj.prim_path: view for obj, view in view_objects(labelled.scene)}
    targets = {label.prim_path: label.target for label in labelled.gold if label.prim_path in views}
    classes: dict[str, Counter[str]] = {}
    for path, iri in targets.items():
        classes.setdefault(reading_of(views[path].name), Counter())[class_name(iri, labelled.tbox)] += 1
    for way in WAYS:
        client = MeteredClient(ScriptedModel(classes))
        grounder = make_way(way, client, min_confidence)
        found = ground(labelled.scene, labelled.tbox, grounder, paths=list(targets)).by_path
        exact = 100 * sum(found[path].class_iri == iri for path, iri in targets.items()) / len(targets)
        usage = client.report.usage
        tokens = (usage.input_tokens + usage.output_tokens) / len(targets)
        prompts = client.report.prompts
        yield f"| {labelled.name} | {len(targets)} | {way.name} | {prompts} | {tokens:,.0f} | {exact:.1f} |"


def class_name(iri: str, tbox: TBox) -> str:
    """Return the name of a class in prompts; local names are unique in the home TBox."""
    return tbox.by_iri[iri].local_name


def make_way(way: Way, client: MeteredClient, min_confidence: float) -> Grounder:
    """Return the grounder that asks in a way."""
    model = LLMGrounder(client, way.options, shares_answers=way.shares_answers, shortlist=way.shortlist)
    return CascadeGrounder(make_grounder("lexical"), model, min_confidence) if way.is_cascade else model


def synthetic_views(count: int) -> Iterator[tuple[str, ObjectView]]:
    """Yield the views of a synthetic room; equal for equal counts."""
    rng = random.Random(SEED)
    nouns = sorted(
        {*chain.from_iterable(home_names().values()), *(row["noun"] for row in read_rows("place_nouns.csv"))}
    )
    rng.shuffle(nouns)
    drawn = rng.choices(nouns, [1 / rank for rank in range(1, len(nouns) + 1)], k=count)
    names = [name_object(noun, number, rng) for number, noun in enumerate(drawn)]
    rooms = [f"{rng.choice(ROOMS)}_{index // 40}" for index in range(count)]
    by_room: dict[str, list[str]] = {}
    for name, room in zip(names, rooms, strict=True):
        by_room.setdefault(room, []).append(name)
    for name, room in zip(names, rooms, strict=True):
        size, position = random_vector(rng, 0.05, 1.5), random_vector(rng, -9, 9)
        siblings = tuple(other for other in by_room[room] if other != name)
        view = ObjectView(name, ("World", room), siblings=siblings, size=size, position=position)
        yield f"/World/{room}/{name}", view


def random_vector(rng: random.Random, low: float, high: float) -> tuple[float, float, float]:
    """Return three numbers between two limits, to the millimetre."""
    return round(rng.uniform(low, high), 3), round(rng.uniform(low, high), 3), round(rng.uniform(low, high), 3)


def name_object(noun: str, number: int, rng: random.Random) -> str:
    """Return a prim name of a noun."""
    words = [rng.choice(COLOURS), *noun.title().split()]
    return rng.choice(PREFIXES) + re.sub(r"\W", "", "".join(words)) + f"_{number}"


if __name__ == "__main__":
    main()
