"""What tokens cost, in US dollars: by the list prices that come with genai-prices, or as the user states it.

The list is the library's own, as it was installed: nothing is fetched. Prices are exact decimals and are rounded only
where they are shown.
"""

from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from typing import Any

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Usage
from usd2kg.grounding.llm.model_reference import PROVIDER_URLS, ModelReference, parse_model_reference

__all__ = ["Tariff", "find_tariff", "format_price", "parse_price"]

Tariff = Callable[[Usage], Decimal]
"""Returns the price in US dollars of one completion's tokens; long prompts may be dearer a token than short ones."""


def find_tariff(model: str) -> Tariff | None:
    """Return the tariff of a model by its name, None where none is known: for servers and weights of one's own.

    Where the user names the server it goes by that one's address: OpenRouter has prices of its own.

    Raises:
        GroundingError: the model names a provider, but is malformed.
    """
    if model.partition(":")[0] not in PROVIDER_URLS:
        return None
    try:
        tariff = _listed(parse_model_reference(model))
        tariff(Usage())
    except (ImportError, LookupError):
        return None
    return tariff


def _listed(address: ModelReference) -> Tariff:
    import genai_prices  # noqa: PLC0415 - the extra may be missing

    where: Any = {"provider_api_url": address.url} if address.has_custom_url else {"provider_id": address.provider}

    def price(usage: Usage) -> Decimal:
        # A server that claims to have read more from its cache than was sent is not believed.
        cached = min(usage.cached_tokens, usage.input_tokens)
        counts = genai_prices.Usage(
            input_tokens=usage.input_tokens,
            cache_read_tokens=cached,
            cache_write_tokens=min(usage.written_tokens, usage.input_tokens - cached),
            output_tokens=usage.output_tokens,
        )
        return genai_prices.calc_price(counts, address.name, **where).total_price

    return price


def parse_price(text: str) -> Tariff:
    """Return the tariff that the user states as `INPUT/OUTPUT`, in dollars for a million tokens each.

    Cached input costs as much as other input.

    Raises:
        GroundingError: it is no such text.
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
    return lambda usage: (usage.input_tokens * paid_in + usage.output_tokens * paid_out) / 1_000_000


def format_price(price: Decimal) -> str:
    """Return a price for people: to the cent, and below a dollar to the hundredth of a cent.

    >>> [format_price(Decimal(text)) for text in ("1234.567", "0.98764", "0.00001", "0")]
    ['$1,234.57', '$0.9876', 'less than $0.0001', '$0']
    """
    if 0 < price < Decimal("0.0001"):
        return "less than $0.0001"
    if price >= 1:
        return f"${price:,.2f}"
    return f"${price:.4f}" if price else "$0"
