"""Tariffs: the price of tokens in US dollars, from the list prices in genai-prices or as the user states them.

The list is that of the installed library; nothing is fetched. Prices are exact decimals, rounded only for display.
"""

from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from typing import Any

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Usage
from usd2kg.grounding.llm.model_reference import KEY_VARIABLES, ModelReference, parse_model_reference
from usd2kg.grounding.llm.settings import BATCH

__all__ = ["Tariff", "discount_batch", "find_tariff", "format_price", "parse_price"]

Tariff = Callable[[Usage], Decimal]
"""Function that returns the price of one completion in US dollars. The price per token may depend on its length."""

_MILLION = 1_000_000
_PRICE_LISTS = {"bedrock": "aws"}
"""Provider → its name in genai-prices, if that differs."""
_SMALLEST_SHOWN = Decimal("0.0001")
"""US dollars."""


def find_tariff(model: str, *, is_batched: bool = False) -> Tariff | None:
    """Return the list price of a model; None if it is not listed, as for local servers and weights.

    If the model string has a URL, the provider is identified by it: OpenRouter, for example, has its own prices. An
    Azure deployment has a price only if it is named after its model.

    Args:
        model: the model string.
        is_batched: return the price in batch jobs: as listed, else by the rule of `discount_batch`.

    Raises:
        GroundingError: the model string has a known provider but is malformed.
    """
    if model.partition(":")[0] not in KEY_VARIABLES:
        return None
    try:
        tariff = _list_price(parse_model_reference(model), is_batched)
        tariff(Usage())
    except (ImportError, LookupError):
        return None
    return tariff


def _list_price(reference: ModelReference, is_batched: bool) -> Tariff:
    import genai_prices  # noqa: PLC0415 - the extra may be missing

    provider = _PRICE_LISTS.get(reference.provider, reference.provider)
    where: Any = {"provider_api_url": reference.url} if reference.has_custom_url else {"provider_id": provider}

    def price(usage: Usage) -> Decimal:
        # Some servers report more cached tokens than input tokens.
        cached = min(usage.cached_tokens, usage.input_tokens)
        counts = genai_prices.Usage(
            input_tokens=usage.input_tokens,
            cache_read_tokens=cached,
            cache_write_tokens=min(usage.written_tokens, usage.input_tokens - cached),
            output_tokens=usage.output_tokens,
        )
        context = {"processing": "batch"} if is_batched else None
        found = genai_prices.calc_price(counts, reference.name, **where, price_context=context)
        is_listed = any(one.when == context for one in found.model.price_variants or ())
        return found.total_price * (BATCH.price_share if is_batched and not is_listed else 1)

    return price


def discount_batch(tariff: Tariff) -> Tariff:
    """Return the batch tariff: the fixed share of all prices that OpenAI, Anthropic and Gemini publish."""
    return lambda usage: tariff(usage) * BATCH.price_share


def parse_price(text: str) -> Tariff:
    """Return the tariff `INPUT/OUTPUT` in dollars per million tokens. Cached input has the price of other input.

    Raises:
        GroundingError: the text is not two prices.
    """
    try:
        rates = [Decimal(part) for part in text.split("/")]
    except InvalidOperation:
        rates = []
    if len(rates) != 2 or not all(rate.is_finite() and rate >= 0 for rate in rates):
        raise GroundingError(
            f"--price {text!r}: no two prices in it; "
            "expected INPUT/OUTPUT in dollars per million tokens, like 0.30/2.50"
        )
    paid_in, paid_out = rates
    return lambda usage: (usage.input_tokens * paid_in + usage.output_tokens * paid_out) / _MILLION


def format_price(price: Decimal) -> str:
    """Return a price for display, to the cent and below a dollar to the hundredth of a cent.

    >>> [format_price(Decimal(text)) for text in ("1234.567", "0.98764", "0.00001", "0")]
    ['$1,234.57', '$0.9876', 'less than $0.0001', '$0']
    """
    if 0 < price < _SMALLEST_SHOWN:
        return f"less than ${_SMALLEST_SHOWN}"
    if price >= 1:
        return f"${price:,.2f}"
    return f"${price:.4f}" if price else "$0"
