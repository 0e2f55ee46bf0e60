"""Report tables of language models: comparison with the study, classes of errors, cost, and cascades."""

from collections.abc import Iterator, Sequence
from decimal import Decimal

from usd2kg.evaluation.matrix import STUDY_ABLATION
from usd2kg.evaluation.metrics.misses import Miss
from usd2kg.evaluation.report.analysis import REGIMES, group_cascades, group_repeats
from usd2kg.evaluation.report.blocks import Table
from usd2kg.evaluation.report.cell_text import ABSENT, interval_text, number_text, published_text, spread_text
from usd2kg.evaluation.report.published import AS_PUBLISHED, Counterpart, find_counterpart, published_condition
from usd2kg.evaluation.report.result_tables import size_title
from usd2kg.evaluation.run_matrix import CellResult, SceneResult
from usd2kg.grounding import Status
from usd2kg.grounding.llm.prices import format_price

__all__ = ["cascade_table", "comparison_table", "cost_table", "error_classes_table"]

_CONDITIONS = (*REGIMES, *STUDY_ABLATION)
_OWN = "lexical"


def comparison_table(result: SceneResult) -> Table | None:
    """Return measured and published results side by side, for the methods of the study and the lexical grounder.

    None if no method of the study was run.
    """
    rows, is_comparable = [], False
    for (method, condition), repeats in group_repeats(result).items():
        counterpart = _counterpart(repeats[0])
        if condition in _CONDITIONS and (counterpart is not None or method == _OWN):
            is_comparable |= counterpart is not None
            published = (ABSENT, ABSENT) if counterpart is None else _published(counterpart, condition)
            rows.append((method, condition, _measured_text(repeats), *published, *_intervals(repeats)))
    columns = ("method", "condition", "measured", "published", "published for", "95 % by distinct name")
    note = (
        f"EMA % / HF1. Published: {AS_PUBLISHED}; for another model, the lowest and the highest of the same strategy."
    )
    title = f"{size_title(result)}: measured and published"
    return Table(title, (*columns, "EMA % end to end"), tuple(rows), note) if is_comparable else None


def _counterpart(done: CellResult) -> Counterpart | None:
    is_thinking = done.evaluation.grounding.settings.get("thinking") == "true"
    return find_counterpart(done.cell.grounder, is_thinking=is_thinking)


def _measured_text(repeats: Sequence[CellResult]) -> str:
    """Return `EMA % / HF1`, or the number of missing answers."""
    summaries = [done.evaluation.summary for done in repeats]
    if failures := repeats[0].failures:
        return f"incomplete: {len(failures)} of {summaries[0].n} failed"
    return f"{spread_text([s.ema for s in summaries], 0)} / {spread_text([s.hf1 for s in summaries], 2, '0')}"


def _intervals(repeats: Sequence[CellResult]) -> tuple[str, str]:
    """Return the interval of EMA by distinct name, and EMA end to end."""
    if repeats[0].failures:
        return ABSENT, ABSENT
    interval = interval_text(repeats[0].evaluation.summary.ema_name_interval, 1)
    return interval, spread_text([done.evaluation.end_to_end.ema for done in repeats], 0)


def _published(counterpart: Counterpart, condition: str) -> tuple[str, str]:
    found = [one for method in counterpart.methods if (one := published_condition(method, condition)) is not None]
    if not found:
        return ABSENT, ABSENT
    if counterpart.is_same:
        return published_text(found[0]), counterpart.methods[0]
    known = [one.ema for one in found if one.ema is not None]
    f1 = [number_text(one.hf1, 2).removeprefix("0") for one in found if one.hf1 is not None]
    text = _range_text([f"{ema:.0f}" for ema in sorted(known)])
    failed = len(found) - len(known)
    models = f"{len(found)} models{f', {failed} failed' if failed else ''}"
    return f"{text} / {_range_text(sorted(f1))}" if f1 else text, models


def _range_text(ascending: Sequence[str]) -> str:
    first, last = ascending[0], ascending[-1]
    return first if first == last else f"{first} to {last}"


def error_classes_table(result: SceneResult) -> Table | None:
    """Return the classes of errors that the study names, by language model and condition; None without such a model.

    The columns after the number of objects add up to that number.
    """
    rows = tuple(
        (method, condition, *map(str, _error_counts(repeats[0])))
        for (method, condition), repeats in group_repeats(result).items()
        if repeats[0].cost is not None
    )
    columns = (
        *("method", "condition", "objects", "right", "superclass collapse", "sibling confusion"),
        *("subclass of the gold class", "other class", "hallucinated class", "degenerate output", "no class", "failed"),
    )
    note = (
        "Superclass collapse: the gold class is a leaf, the answer one of its superclasses. Sibling confusion: both "
        "have a direct superclass in common. Where the gold class is a superclass, a leaf that the study calls a "
        "sibling is a subclass of it. A hallucinated class is not in the ontology, even after a repair. The study "
        "names these errors without counts; one of its results is degenerate output throughout: Qwen 3.5-27B "
        "thinking A under opaque names."
    )
    return Table(f"{size_title(result)}: classes of errors", columns, rows, note) if rows else None


def _error_counts(done: CellResult) -> Iterator[int]:
    cost, misses, scores = done.cost, done.evaluation.summary.misses, done.evaluation.scores
    assert cost is not None
    right, failed = sum(score.is_exact for score in scores), sum(score.status is Status.FAILED for score in scores)
    collapse, sibling = misses[Miss.SUPERCLASS_COLLAPSE], misses[Miss.SIBLING]
    specific, unanswered = misses[Miss.TOO_SPECIFIC], misses[Miss.UNANSWERED]
    lost = cost.hallucinated_objects + cost.degenerate_objects
    yield len(scores)
    yield right
    yield collapse
    yield sibling
    yield specific
    yield len(scores) - right - collapse - sibling - specific - unanswered
    yield cost.hallucinated_objects
    yield cost.degenerate_objects
    yield unanswered - lost - failed
    yield failed


def cost_table(results: Sequence[SceneResult]) -> Table | None:
    """Return prompts, tokens, dollars and seconds of each language model result, with a total; None if none."""
    each = [(result.spec.name, done) for result in results for done in result.cells if done.cost is not None]
    if not each:
        return None
    columns = (
        *("scene", "method", "condition", "prompts", "completions", "cached", "repairs", "degenerate"),
        *("input tokens", "output tokens", "dollars", "paid now", "seconds"),
    )
    rows = [(scene, done.cell.method, done.cell.condition, *_cost_texts([done])) for scene, done in each]
    total = ("all", "", "", *_cost_texts([done for _, done in each]))
    note = (
        "Tokens and dollars are those of all completions, cached ones included, at list prices or those of --price; a "
        "completion that several results use counts in each. Paid now is for completions that were not cached when the "
        "result was computed. Seconds are those of the run that computed the result: a replay is faster than the model."
    )
    return Table("Cost of language models", columns, (*rows, total), note)


def _cost_texts(results: Sequence[CellResult]) -> Iterator[str]:
    costs = [done.cost for done in results if done.cost is not None]
    for key in ("prompts", "completions", "cached", "repairs", "degenerate", "input_tokens", "output_tokens"):
        yield f"{sum(getattr(cost, key) for cost in costs):,}"
    yield _sum_text([cost.dollars for cost in costs])
    yield _sum_text([cost.paid for cost in costs])
    yield f"{sum(done.evaluation.seconds for done in results):.1f}"


def _sum_text(prices: Sequence[Decimal | None]) -> str:
    """Return the sum of prices; unknown if one is unknown."""
    known = [price for price in prices if price is not None]
    return format_price(sum(known, Decimal(0))) if len(known) == len(prices) else "unknown"


def cascade_table(result: SceneResult) -> Table | None:
    """Return accuracy and cost of each cascade by threshold; None if none was run."""
    rows = tuple(
        (method, condition, f"{done.cell.cascade:g}", _measured_text([done]), *_intervals([done]), *_asked(done))
        for (method, condition), cells in group_cascades(result).items()
        for done in cells
    )
    columns = ("model", "condition", "threshold", "EMA % / HF1", "95 % by distinct name", "EMA % end to end")
    note = "The model is asked about objects for which the confidence of the lexical grounder is below the threshold."
    title = f"{size_title(result)}: cascades"
    return Table(title, (*columns, "objects asked", "tokens", "dollars"), rows, note) if rows else None


def _asked(done: CellResult) -> tuple[str, str, str]:
    if done.cost is None:
        return ABSENT, ABSENT, ABSENT
    tokens = done.cost.input_tokens + done.cost.output_tokens
    return str(done.cost.objects), f"{tokens:,}", _sum_text([done.cost.dollars])
