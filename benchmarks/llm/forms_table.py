"""print_table: accuracy and cost of each model and form of the prompt, over all recorded scenes and by scene."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from benchmarks.labelled_scenes import LabelledScene
from usd2kg.evaluation.metrics.hierarchical import mean_hierarchical_score
from usd2kg.evaluation.metrics.intervals import wilson_interval
from usd2kg.evaluation.score import Score
from usd2kg.grounding import Status
from usd2kg.ontology import ClassIRI

__all__ = ["Outcome", "print_table"]


@dataclass(frozen=True)
class Outcome:
    """The answers about the objects of a scene."""

    model: str
    form: str
    scene: str
    input_tokens: int
    cached_tokens: int
    output_tokens: int
    seconds: float
    """Processor time; NaN if all completions were stored."""
    answers: Mapping[str, ClassIRI | None]
    """Prim path → class."""


def print_table(outcomes: Sequence[Outcome], scenes: Sequence[LabelledScene], bases: Mapping[str, str]) -> None:
    """Print a row for each model and form.

    Args:
        outcomes: the answers.
        scenes: the scenes with their labels; others are left out.
        bases: form → the form that its answers are compared to.
    """
    names = [scene.name for scene in scenes]
    print(f"| model | form | n | tokens per object: input, cached | s per object | {' | '.join(names)} ", end="")
    print("| exact % (95 %) | accepted % | HF1 | differs from its base |")
    print(f"{'| --- ' * (9 + len(names))}|")
    models = list(dict.fromkeys(one.model for one in outcomes))
    for key in sorted(dict.fromkeys((one.model, one.form) for one in outcomes), key=lambda key: models.index(key[0])):
        own = answers_of(outcomes, *key, names)
        base = {one.scene: one for one in answers_of(outcomes, key[0], bases.get(key[1], key[1]), names)}
        print(row_of(own, base, scenes))


def answers_of(outcomes: Sequence[Outcome], model: str, form: str, scenes: Sequence[str]) -> list[Outcome]:
    """Return the outcomes of a model and form."""
    return [one for one in outcomes if (one.model, one.form) == (model, form) and one.scene in scenes]


def row_of(own: Sequence[Outcome], base: Mapping[str, Outcome], scenes: Sequence[LabelledScene]) -> str:
    """Return the row of a model and form."""
    by_scene = {one.scene: scores_of(one, next(s for s in scenes if s.name == one.scene)) for one in own}
    scores = [score for part in by_scene.values() for score in part]
    n, exact = len(scores), sum(score.is_exact for score in scores)
    interval = wilson_interval(exact, n)
    means = mean_hierarchical_score(scores, scenes[0].tbox)
    shares = [
        f"{sum(s.is_exact for s in by_scene[scene.name])} of {len(by_scene[scene.name])}"
        if scene.name in by_scene
        else "–"
        for scene in scenes
    ]
    both = [one for one in own if one.scene in base]
    other = sum(iri != base[one.scene].answers.get(path) for one in both for path, iri in one.answers.items())
    tokens = f"{sum(o.input_tokens for o in own) / n:,.0f}, {sum(o.cached_tokens for o in own) / n:,.0f}"
    return (
        f"| {own[0].model} | {own[0].form} | {n} | {tokens} | {sum(o.seconds for o in own) / n:.1f} "
        f"| {' | '.join(shares)} | {100 * exact / n:.0f} ({100 * interval.lower:.0f}–{100 * interval.upper:.0f}) "
        f"| {100 * sum(s.is_accepted for s in scores) / n:.0f} | {means.f1:.2f} | {other if both else '–'} |"
    )


def scores_of(outcome: Outcome, scene: LabelledScene) -> list[Score]:
    """Return the scores of the objects that were asked about."""
    return [
        Score(
            id=label.prim_path,
            name=label.prim_path.rpartition("/")[2],
            target=label.target,
            also=label.also,
            answer=(answer := outcome.answers[label.prim_path]),
            confidence=None,
            status=Status.GROUNDED if answer else Status.UNREADABLE,
            explanation="",
        )
        for label in scene.gold
        if label.prim_path in outcome.answers
    ]
