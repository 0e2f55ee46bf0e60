"""Words of class labels: normal forms, head nouns, and nouns with the same meaning."""

import re

from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.knowledge import word_set
from usd2kg.words import split_identifier

__all__ = [
    "SENSE_KEY",
    "equivalent_nouns",
    "head_noun_of",
    "normalise_label",
    "words_of_label",
]

SENSE_KEY = re.compile(r"^([^.\s]+)\.[nvasr]\.(?:\S*?\.\.(\S*)|\S*)$")
"""A class named after a WordNet sense, possibly with a hypernym: `chair.n.01`, `chair.n.wn.artifact..seat`."""
_MAIN_EQUIPMENT = ("equipment", "device", "unit")
_EQUIPMENT = (
    *(*_MAIN_EQUIPMENT, "instrument", "apparatus", "machine", "appliance", "system", "tool"),
    *("supply", "product", "item", "article", "accessory"),
)
"""Head nouns that ontologies use interchangeably, most frequent first; the order decides which one is tried first."""
_MEASURES = word_set("lexical", "measure_nouns")


def words_of_label(text: str) -> list[str]:
    """Return the words of a label in lower case, without bracketed remarks, numbers and the tail of a sense key."""
    # Most labels are lower-case words already.
    if text.islower() and text.isascii() and text.replace(" ", "").isalpha():
        return text.split()
    plain = re.sub(r"\(.*?\)|\[.*?\]", " ", SENSE_KEY.sub(r"\1", text))
    return [word.lower() for word in split_identifier(plain) if not word.isdigit()]


def normalise_label(text: str, taxonomy: Taxonomy) -> str:
    """Return the words of a label, the last one in the singular."""
    *words, last = words_of_label(text) or [""]
    return " ".join([*words, taxonomy.singular(last)])


def head_noun_of(label: str) -> str:
    """Return the head noun of a label: “chair” for “chair of state”; empty for a label without words."""
    words = words_of_label(label)
    if "of" in words[1:]:
        words = words[: words.index("of", 1)]
    return words[-1] if words else ""


def equivalent_nouns(label: str, taxonomy: Taxonomy, *, is_noun: bool) -> list[str]:
    """Return nouns of the taxonomy with the meaning of a label: dental unit → dental device, portion of bread → bread.

    Args:
        label: a normalised label.
        taxonomy: the nouns.
        is_noun: whether the label itself is a noun of the taxonomy; then only the main words for equipment count.
    """
    if len(alternatives := _split_alternatives(label.split())) > 1:
        nouns = [normalise_label(words, taxonomy).replace(" ", "") for words in alternatives]
        return [noun for noun in nouns if noun in taxonomy]
    *before, last = label.split()
    if "of" in before and _MEASURES.issuperset(before[: before.index("of")]):
        return [noun for noun in ["".join((*before[before.index("of") + 1 :], last))] if noun in taxonomy]
    heads = _MAIN_EQUIPMENT if is_noun else _EQUIPMENT
    if not before or last not in heads:
        return []
    found = [noun for head in heads if head != last and (noun := "".join((*before, head))) in taxonomy]
    return found if is_noun else found[:1]


def _split_alternatives(words: list[str]) -> list[str]:
    """Return the labels that a label with “and” or “or” joins.

    >>> _split_alternatives(["cleaning", "and", "waste", "equipment"])
    ['cleaning equipment', 'waste equipment', 'cleaning']
    >>> _split_alternatives(["newspaper", "or", "magazine"])
    ['newspaper', 'magazine']
    """
    at = next((at for at, word in enumerate(words) if word in {"and", "or"} and 0 < at < len(words) - 1), None)
    if at is None:
        return [" ".join(words)]
    before, behind = words[:at], words[at + 1 :]
    if len(behind) == 1:
        return [" ".join(before), *_split_alternatives(behind)]
    return [" ".join((*before, behind[-1])), *_split_alternatives(behind), " ".join(before)]
