"""About how many tokens a prompt and its answer have, where no server has counted them."""

import json
from fractions import Fraction

from usd2kg.grounding.llm.completion import Request, Usage
from usd2kg.grounding.llm.prompt_text import estimate_tokens
from usd2kg.grounding.llm.prompts import Batch

__all__ = ["estimate_input", "estimate_usage"]

_REASONING_TOKENS = 120
"""About what a model writes of an object where it is told to reason before it answers."""
_PIXELS_PER_TOKEN = 750
_PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def estimate_usage(batch: Batch) -> Usage:
    """Return about how many tokens a prompt and its answer have, at four bytes each, before anybody is asked.

    The answer is taken to be a row with a class name of middle length for each object, and 120 tokens of reasoning
    where the prompt asks for it. What a model reasons by itself, repairs, and a server's cache are left out.
    """
    request = batch.request
    letters = round(Fraction(sum(map(len, batch.classes)), max(1, len(batch.classes))))
    answer = json.dumps({number: {"class": "x" * letters} for number in batch.numbers})
    rows = request.schema["properties"].values()
    reasoning = sum(_REASONING_TOKENS for row in rows if "reasoning" in row["properties"])
    input_tokens, output_tokens = estimate_input(request), estimate_tokens(answer) + reasoning
    return Usage(input_tokens, 0, output_tokens, input_tokens + output_tokens)


def estimate_input(request: Request) -> int:
    """Return about how many tokens a prompt has: one for four bytes of text, and one for 750 pixels of an image.

    https://platform.claude.com/docs/en/build-with-claude/vision tells the pixels of a token at Anthropic's; others
    count in other ways.
    """
    return estimate_tokens(request.system + request.user) + sum(map(_estimate_image, request.images))


def _estimate_image(png: bytes) -> int:
    """Tokens of a PNG file by the size in its header, https://www.w3.org/TR/png-3/#11IHDR; 0 where it has none."""
    if not png.startswith(_PNG_SIGNATURE):
        return 0
    width, height = int.from_bytes(png[16:20]), int.from_bytes(png[20:24])
    return -(-width * height // _PIXELS_PER_TOKEN)
