"""What is told of asking a model, before it is asked and after."""

from collections import Counter
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING

from usd2kg.cli.output import emit, format_table, printable, talk

if TYPE_CHECKING:
    from usd2kg.grounding import CascadeGrounder, Grounding
    from usd2kg.grounding.llm.asking import RunReport
    from usd2kg.grounding.llm.grounder import LLMGrounder
    from usd2kg.grounding.llm.prices import Tariff
    from usd2kg.grounding.llm.prompts import Batch

__all__ = ["show_plan", "tell_cost", "tell_tiers"]


def show_plan(batches: "list[Batch]", object_count: int, tariff: "Tariff | None", output: Path | None) -> None:
    """Print the prompts that would be sent, what they share once, and their size and price on stderr."""
    from usd2kg.grounding.llm.estimates import estimate_usage  # noqa: PLC0415
    from usd2kg.grounding.llm.prices import format_price  # noqa: PLC0415

    emit(printable("\n".join(_prompt_texts(batches))), output)
    usages = [estimate_usage(batch) for batch in batches]
    tokens = sum(usage.input_tokens for usage in usages)
    share = tokens / max(1, object_count)
    price = "price unknown" if tariff is None else f"about {format_price(sum(map(tariff, usages), Decimal(0)))}"
    talk(
        f"{len(batches)} prompts for {object_count} objects, about {tokens:,} input tokens ({share:,.0f} an object) "
        f"and {sum(usage.output_tokens for usage in usages):,} output tokens, {price}"
    )


def _prompt_texts(batches: "list[Batch]") -> Iterator[str]:
    told: str | None = None
    for number, batch in enumerate(batches, start=1):
        if batch.request.system != told:
            told = batch.request.system
            yield f"=== instructions ===\n{told}\n"
        yield f"=== prompt {number} of {len(batches)} ===\n{batch.request.user}\n"


def tell_cost(report: "RunReport", result: "Grounding") -> None:
    """Print on stderr, in one line, what a run took and what came of it."""
    from usd2kg.grounding.llm.prices import format_price  # noqa: PLC0415

    unread = sum(1 for prediction in result.predictions if prediction.class_iri is None)
    usage, traffic = report.usage, report.traffic
    guessed = f" ({usage.estimated_tokens:,} of all estimated)" if usage.estimated_tokens else ""
    price = "price unknown" if report.price is None else format_price(report.price)
    talk(
        f"{report.objects} objects by {report.prompts} prompts: {report.completions} completions asked for, "
        f"{report.cached} known before, {report.repairs} repairs, {report.degenerate} degenerate, "
        f"{report.failed} prompts failed, {unread} objects without a class; "
        f"{traffic.attempts} requests sent, {traffic.retries} of them again, {traffic.waits} waits "
        f"of {traffic.waited_s:.1f} s in all; {usage.input_tokens:,} input tokens "
        f"({usage.cached_tokens:,} of them cached), {usage.output_tokens:,} output tokens{guessed}, {price}, "
        f"{report.seconds:.1f} s"
    )


def tell_tiers(result: "Grounding", tiers: "CascadeGrounder | None", model: "LLMGrounder | None") -> None:
    """Print on stderr, as a table, how many objects each tier decided and what it took."""
    from usd2kg.grounding.llm.prices import format_price  # noqa: PLC0415

    counts = Counter(prediction.grounder for prediction in result.predictions)
    seconds = (
        {} if tiers is None else {tiers.first.name: tiers.report.first_s, tiers.second.name: tiers.report.second_s}
    )
    rows = []
    for name, count in counts.items():
        tokens = price = ""
        if model is not None and name == model.name:
            usage = model.report.usage
            tokens = f"{usage.input_tokens + usage.output_tokens:,}"
            price = "" if model.report.price is None else format_price(model.report.price)
        rows.append((name, str(count), tokens, price, f"{seconds[name]:.1f}" if name in seconds else ""))
    talk(format_table(("tier", "objects", "tokens", "price", "seconds"), rows).rstrip())
    if tiers is not None and tiers.report.kept:
        talk(f"the model had no class for {tiers.report.kept} objects, which stay as they were")
