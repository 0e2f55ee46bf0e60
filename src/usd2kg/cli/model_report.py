"""Reports of language model runs: the prompts of a dry run, cost, and the share of each tier."""

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from usd2kg.cli.output import count_noun, emit, notify, replace_controls
from usd2kg.cli.text_table import format_table

if TYPE_CHECKING:
    from usd2kg.grounding import CascadeGrounder, Grounding
    from usd2kg.grounding.llm.completion import Request
    from usd2kg.grounding.llm.grounder import LLMGrounder
    from usd2kg.grounding.llm.metered_client import RunReport
    from usd2kg.grounding.llm.prices import Tariff
    from usd2kg.grounding.llm.prompts import Batch

__all__ = ["print_prompts", "print_requests", "report_cost", "report_prompts", "report_tiers"]


def print_prompts(batches: "list[Batch]", object_count: int, tariff: "Tariff | None", output: Path | None) -> None:
    """Print the prompts of a dry run, and to stderr their estimated tokens and price."""
    from usd2kg.grounding.llm.estimates import estimate_run  # noqa: PLC0415

    requests = [batch.request for batch in batches]
    print_requests(requests, output)
    usage, price = estimate_run(requests, tariff)
    per_object = usage.input_tokens / max(1, object_count)
    notify(
        f"{count_noun(len(batches), 'prompt')} for {count_noun(object_count, 'object')}, "
        f"about {usage.input_tokens:,} input tokens ({per_object:,.0f} per object) "
        f"and {usage.output_tokens:,} output tokens, {price}"
    )


def print_requests(requests: "Sequence[Request]", output: Path | None) -> None:
    """Print prompts; instructions shared by successive prompts are printed once."""
    emit(replace_controls("\n".join(_prompt_texts(requests))), output)


def _prompt_texts(requests: "Sequence[Request]") -> Iterator[str]:
    instructions: str | None = None
    for number, request in enumerate(requests, start=1):
        if request.system != instructions:
            instructions = request.system
            yield f"=== instructions ===\n{instructions}\n"
        yield f"=== prompt {number} of {len(requests)} ===\n{request.user}\n"


def report_cost(report: "RunReport", grounding: "Grounding") -> None:
    """Print to stderr the completions, requests, tokens, price and time of a run, and why prompts have no completion.

    A run without any completion is an error, which states the reason.
    """
    unclassified = sum(1 for prediction in grounding.predictions if prediction.class_iri is None)
    notify(
        f"{count_noun(report.objects, 'object')} in {count_noun(report.prompts, 'prompt')}: "
        f"{count_noun(report.completions, 'new completion')}, {report.cached} cached, "
        f"{count_noun(report.repairs, 'repair')}, {report.degenerate} degenerate, "
        f"{count_noun(report.failed, 'prompt')} failed, {count_noun(unclassified, 'object')} without a class; "
        f"{_traffic_text(report)}"
    )
    if report.problem and (report.completions or report.cached):
        notify(f"{count_noun(report.failed, 'prompt')} without a completion ({report.problem})")


def report_prompts(report: "RunReport") -> None:
    """Print to stderr, on one line, the completions, requests, tokens, price and time of prompts without objects."""
    notify(
        f"{count_noun(report.prompts, 'prompt')}: {count_noun(report.completions, 'new completion')}, "
        f"{report.cached} cached, {count_noun(report.failed, 'prompt')} failed; {_traffic_text(report)}"
    )


def _traffic_text(report: "RunReport") -> str:
    """Return requests, tokens, price and time of a run."""
    from usd2kg.grounding.llm.prices import format_price  # noqa: PLC0415

    usage, traffic = report.usage, report.traffic
    estimated = f" ({usage.estimated_tokens:,} of all estimated)" if usage.estimated_tokens else ""
    price = "price unknown" if report.price is None else format_price(report.price)
    return (
        f"{count_noun(traffic.attempts, 'request')} sent, {traffic.retries} retried, "
        f"{count_noun(traffic.waits, 'wait')} of {traffic.waited_s:.1f} s in total; "
        f"{usage.input_tokens:,} input tokens ({usage.cached_tokens:,} cached by the provider), "
        f"{usage.output_tokens:,} output tokens{estimated}, {price}, "
        f"{report.seconds:.1f} s"
    )


def report_tiers(grounding: "Grounding", cascade: "CascadeGrounder | None", model: "LLMGrounder | None") -> None:
    """Print to stderr how many objects each tier decided, and its tokens, price and time."""
    from usd2kg.grounding.llm.prices import format_price  # noqa: PLC0415

    counts = Counter(prediction.chosen_by for prediction in grounding.predictions)
    seconds: dict[str, float] = {}
    if cascade is not None:
        seconds = {cascade.first.name: cascade.report.first_s, cascade.second.name: cascade.report.second_s}
    rows = []
    for name, count in counts.items():
        tokens = price = ""
        if model is not None and name == model.name:
            usage = model.report.usage
            tokens = f"{usage.input_tokens + usage.output_tokens:,}"
            price = "" if model.report.price is None else format_price(model.report.price)
        rows.append((name, str(count), tokens, price, f"{seconds[name]:.1f}" if name in seconds else ""))
    notify(format_table(("tier", "objects", "tokens", "price", "seconds"), rows).rstrip())
    if cascade is not None and cascade.report.kept:
        kept = count_noun(cascade.report.kept, "object")
        notify(f"the model had no class for {kept}; the first tier's class is kept")
