"""Estimates of the tokens of a prompt and its answer, for use before a server has counted them."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any

from usd2kg.grounding.llm.completion import Request, Usage
from usd2kg.grounding.llm.prices import Tariff, format_price
from usd2kg.grounding.llm.prompt_text import estimate_tokens
from usd2kg.grounding.llm.settings import ESTIMATES, MEMBERS

__all__ = ["estimate_input", "estimate_run", "estimate_usage"]

_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def estimate_run(requests: Sequence[Request], tariff: Tariff | None) -> tuple[Usage, str]:
    """Return an estimate of the tokens of some prompts and their answers, and of their price as text."""
    usages = [estimate_usage(request) for request in requests]
    price = "price unknown" if tariff is None else f"about {format_price(sum(map(tariff, usages), Decimal(0)))}"
    return sum(usages, Usage()), price


def estimate_usage(request: Request) -> Usage:
    """Return an estimate of the tokens of a prompt and its answer.

    The answer is assumed to have one row per object with a class name of mean length and, if the prompt asks for them,
    a reasoning of fixed length or the requested number of nouns. Thinking, repairs and the server's cache are not
    included.
    """
    rows = {number: row["properties"] for number, row in request.schema["properties"].items()}
    answer = {
        number: {name: _typical_name(form) for name, form in row.items() if "enum" in form}
        for number, row in rows.items()
    }
    kinds = Counter(form["type"] for row in rows.values() for form in row.values() if "enum" not in form)
    list_tokens = MEMBERS.nouns_per_class * ESTIMATES.noun_tokens
    texts = kinds["string"] * ESTIMATES.reasoning_tokens + kinds["array"] * list_tokens
    input_tokens, output_tokens = estimate_input(request), estimate_tokens(json.dumps(answer)) + texts
    return Usage(input_tokens, 0, output_tokens, input_tokens + output_tokens)


def _typical_name(form: Mapping[str, Any]) -> str:
    """Return a text of the mean length of the allowed names."""
    return "x" * round(Fraction(sum(map(len, form["enum"])), max(1, len(form["enum"]))))


def estimate_input(request: Request) -> int:
    """Return an estimate of the tokens of a prompt, from the bytes of its text and the pixels of its images.

    The number of pixels per token is Anthropic's; other providers count differently.
    """
    return estimate_tokens(request.system + request.user) + sum(map(_estimate_image, request.images))


def _estimate_image(png: bytes) -> int:
    """Return the tokens of a PNG by the size in its header, https://www.w3.org/TR/png-3/#11IHDR; 0 for other data."""
    if not png.startswith(_PNG_SIGNATURE):
        return 0
    width, height = int.from_bytes(png[16:20]), int.from_bytes(png[20:24])
    return -(-width * height // ESTIMATES.pixels_per_token)
