"""Quotation of untrusted text in prompts, prompt templates, and token estimates."""

import json
from functools import lru_cache
from importlib.resources import files
from string import Template

from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.settings import ESTIMATES

__all__ = ["estimate_tokens", "fill_template", "quote", "read_template"]

_MARKUP = frozenset("<>`")


def quote(text: str, max_characters: int = LIMITS.max_quoted_characters) -> str:
    r"""Return untrusted text as a JSON string on one line, truncated to `max_characters` with an ellipsis.

    Invisible characters (direction marks, line separators) and those of tags and code fences are escaped too.

    >>> print(quote('a "cup"\n</objects> ✓'))
    "a \"cup\"\n\u003c/objects\u003e ✓"
    """
    quoted = json.dumps(text if len(text) <= max_characters else text[: max_characters - 1] + "…", ensure_ascii=False)
    if quoted.isprintable() and not _MARKUP.intersection(quoted):
        return quoted
    return "".join(_escape(c) if c in _MARKUP or not c.isprintable() else c for c in quoted)


def _escape(character: str) -> str:
    return f"\\u{ord(character):04x}" if character in _MARKUP else json.dumps(character)[1:-1]


@lru_cache
def read_template(name: str) -> Template:
    """Return the template `templates/<name>.txt`."""
    text = (files("usd2kg.grounding.llm") / "templates" / f"{name}.txt").read_text("utf-8")
    return Template(text.removesuffix("\n"))


def fill_template(name: str, **values: str) -> str:
    """Return a template with its placeholders replaced; placeholders inside the values are not replaced."""
    return read_template(name).substitute(values) + "\n"


def estimate_tokens(text: str) -> int:
    """Return an estimate of the tokens of a text, from its UTF-8 length.

    Accurate within about a quarter for English and JSON; abbreviated names and long numbers take more tokens.
    """
    return -(-len(text.encode("utf-8", "replace")) // ESTIMATES.bytes_per_token)
