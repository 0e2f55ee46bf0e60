"""Estimates of the tokens of a prompt and its answer, for use before a server has counted them."""

import json
from fractions import Fraction

from usd2kg.grounding.llm.completion import Request, Usage
from usd2kg.grounding.llm.prompt_text import estimate_tokens
from usd2kg.grounding.llm.prompts import Batch
from usd2kg.grounding.llm.settings import ESTIMATES

__all__ = ["estimate_input", "estimate_usage"]

_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def estimate_usage(batch: Batch) -> Usage:
    """Return an estimate of the tokens of a prompt and its answer.

    The answer is assumed to have one row per object, with a class name of mean length and, if the prompt asks for it,
    a reasoning of fixed length. Thinking, repairs and the server's cache are not included.
    """
    request = batch.request
    letters = round(Fraction(sum(map(len, batch.classes)), max(1, len(batch.classes))))
    answer = json.dumps({number: {"class": "x" * letters} for number in batch.numbers})
    rows = request.schema["properties"].values()
    reasoning = sum(ESTIMATES.reasoning_tokens for row in rows if "reasoning" in row["properties"])
    input_tokens, output_tokens = estimate_input(request), estimate_tokens(answer) + reasoning
    return Usage(input_tokens, 0, output_tokens, input_tokens + output_tokens)


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
