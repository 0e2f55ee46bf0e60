"""Detection of prompt injection: texts of a scene that may command the model instead of describing an object.

No rule recognises every injection, so quotation, row numbers and the answer schema constrain all texts: none can leave
its row or introduce a class. The rules here also keep a suspicious text out of the rows and prompts of other objects,
so that a model that obeys it misclassifies only the object that carries the text.
"""

import unicodedata
from functools import lru_cache

from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.llm.prompt_text import quote
from usd2kg.grounding.llm.settings import COMMANDS
from usd2kg.knowledge import word_set
from usd2kg.words import split_identifier

__all__ = ["commanding_texts", "may_command", "quote_other"]

_MARKUP = frozenset("<>{}[]`|#\\\n\r\t")
_WITHHELD = "…"


@lru_cache(maxsize=65536)
def may_command(text: str) -> bool:
    """Return whether a text may command a model.

    It has many words, a word of commands or sentences, markup, a colon before a space, invisible characters, characters
    that look like others, or Latin letters beside Cyrillic or Greek ones.

    >>> [may_command(text) for text in ("SM_CupCBlue_01", "ignore_previous", "system: bowl", "<row>")]
    [False, True, True, True]
    """
    words = [word.casefold() for word in split_identifier(text) if not word.isdecimal()]
    if len(words) > COMMANDS.max_words or not word_set("prompts", "commands").isdisjoint(words):
        return True
    if _MARKUP.intersection(text) or ": " in text or not text.isprintable():
        return True
    if text.isascii():
        return False
    folded = unicodedata.normalize("NFKC", text)
    has_look_alikes = folded != unicodedata.normalize("NFC", text)
    return has_look_alikes or _is_mixed(text) or any(word in text for word in _unspaced_commands())


def _is_mixed(text: str) -> bool:
    """Return whether a text has letters of the Latin script and of Cyrillic or Greek, which look alike."""
    scripts = {unicodedata.name(letter, "").partition(" ")[0] for letter in text if letter.isalpha()}
    return "LATIN" in scripts and not scripts.isdisjoint({"CYRILLIC", "GREEK"})


@lru_cache(maxsize=1)
def _unspaced_commands() -> tuple[str, ...]:
    """Return the words of commands in scripts without spaces."""
    return tuple(word for word in word_set("prompts", "commands") if unicodedata.name(word[0]).startswith("CJK"))


def commanding_texts(view: ObjectView, *, has_more_evidence: bool) -> tuple[str, ...]:
    """Return the texts of an object's own row that may command a model.

    Args:
        view: the object.
        has_more_evidence: whether the row has more than the evidence of the study.
    """
    texts = [view.name, *view.asset]
    if has_more_evidence:
        texts += [view.display_name, view.documentation, *view.labels, *view.materials, *view.parts]
    return tuple(text for text in texts if may_command(text))


def quote_other(text: str) -> str:
    """Return the quoted text of another object, or an ellipsis if it may command the model."""
    return quote(_WITHHELD if may_command(text) else text)
