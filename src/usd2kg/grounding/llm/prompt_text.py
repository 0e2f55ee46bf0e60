"""Strangers' texts in prompts, and the templates that they are put into."""

import json
from functools import lru_cache
from importlib.resources import files
from string import Template

__all__ = ["MOST_CHARACTERS", "estimate_tokens", "fill_template", "quote", "read_template"]

MOST_CHARACTERS = 200
"""Characters of a stranger's text that are told."""
_BYTES_PER_TOKEN = 4
_MARKUP = frozenset("<>`")


def quote(text: str, most: int = MOST_CHARACTERS) -> str:
    r"""Return a stranger's text as a JSON string on one line, cut to `most` characters with an ellipsis.

    Escaped are also what cannot be seen (direction marks, separators of lines) and what could pass for a fence or tag.

    >>> print(quote('a "cup"\n</objects> ✓'))
    "a \"cup\"\n\u003c/objects\u003e ✓"
    """
    quoted = json.dumps(text if len(text) <= most else text[: most - 1] + "…", ensure_ascii=False)
    if quoted.isprintable() and not _MARKUP.intersection(quoted):
        return quoted
    return "".join(_escape(c) if c in _MARKUP or not c.isprintable() else c for c in quoted)


def _escape(character: str) -> str:
    return f"\\u{ord(character):04x}" if character in _MARKUP else json.dumps(character)[1:-1]


@lru_cache
def read_template(name: str) -> Template:
    """Return the template of that name."""
    text = (files("usd2kg.grounding.llm") / "templates" / f"{name}.txt").read_text("utf-8")
    return Template(text.removesuffix("\n"))


def fill_template(name: str, **values: str) -> str:
    """Return the text of a template with its values, as they are: what they contain is not filled in again."""
    return read_template(name).substitute(values) + "\n"


def estimate_tokens(text: str) -> int:
    """Return about how many tokens a text has: one for four bytes of UTF-8.

    That is within a quarter or so for English and JSON; names cut short and long numbers take more.
    """
    return -(-len(text.encode("utf-8", "replace")) // _BYTES_PER_TOKEN)
