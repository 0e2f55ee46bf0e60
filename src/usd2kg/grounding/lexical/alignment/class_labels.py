"""What the labels of classes say: their words, the noun at their end, and the nouns that say the same."""

import re
from collections import Counter

from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import TBox
from usd2kg.words import split_identifier

__all__ = ["SENSE_KEY", "affixes_of", "head_of", "phrase_of", "said_otherwise", "wordings", "words_of_label"]

_EQUIPMENT = ("equipment", "device", "unit")
_ANY_EQUIPMENT = (
    *(*_EQUIPMENT, "instrument", "apparatus", "machine", "appliance", "system", "tool"),
    *("supply", "product", "item", "article", "accessory"),
)
"""Words that ontologists use one for another at the end of a label, the commonest first: mostly, or where need be."""
_MEASURES = frozenset(["article", "item", "piece", "portion"])
"""Words before an "of" that only make one thing of what stands behind it."""
SENSE_KEY = re.compile(r"^([^.\s]+)\.[nvasr]\.(?:\S*?\.\.(\S*)|\S*)$")
"""A class called after a sense of WordNet, maybe with what is above it: `chair.n.01`, `chair.n.wn.artifact..seat`."""


def words_of_label(text: str) -> list[str]:
    """Return the words of a label in lower case, without remarks in brackets, numbers and the rest of a sense key."""
    # Most terms are lower-case words already: there is nothing to take apart.
    if text.islower() and text.isascii() and text.replace(" ", "").isalpha():
        return text.split()
    plain = re.sub(r"\(.*?\)|\[.*?\]", " ", SENSE_KEY.sub(r"\1", text))
    return [word.lower() for word in split_identifier(plain) if not word.isdigit()]


def phrase_of(text: str, taxonomy: Taxonomy) -> str:
    """Return the words of a text, the last one in the singular."""
    *words, last = words_of_label(text) or [""]
    return " ".join([*words, taxonomy.singular(last)])


def head_of(label: str) -> str:
    """Return the word that says what kind it is: a chair of state is a chair."""
    words = words_of_label(label)
    if "of" in words[1:]:
        words = words[: words.index("of", 1)]
    return words[-1] if words else ""


def affixes_of(tbox: TBox, taxonomy: Taxonomy) -> frozenset[str]:
    """Return first words that are the ontology's own jargon: shared by many classes, and no thing's name.

    Nor do they make known nouns with what follows: `designed` is jargon, the `cooking` of a cooking appliance is not.
    """
    labels = [words for cls in tbox.classes if len(words := words_of_label(cls.local_name)) > 1]
    firsts = Counter(words[0] for words in labels)
    told = {words[0] for words in labels if "".join(words) in taxonomy}
    return frozenset(word for word, count in firsts.items() if count >= 3 and word not in taxonomy and word not in told)


def said_otherwise(label: str, taxonomy: Taxonomy, *, is_noun: bool) -> list[str]:
    """Return the nouns of the taxonomy that say what a label says: a dental unit is a device, a portion of bread bread.

    Args:
        label: the label, in the singular.
        taxonomy: the nouns.
        is_noun: whether the label itself is one; then it is what it says but for equipment of all kinds.
    """
    if len(alternatives := _alternatives(label.split())) > 1:
        said = [phrase_of(words, taxonomy).replace(" ", "") for words in alternatives]
        return [noun for noun in said if noun in taxonomy]
    *before, last = label.split()
    if "of" in before and _MEASURES.issuperset(before[: before.index("of")]):
        return [noun for noun in ["".join((*before[before.index("of") + 1 :], last))] if noun in taxonomy]
    heads = _EQUIPMENT if is_noun else _ANY_EQUIPMENT
    if not before or last not in heads:
        return []
    found = [noun for head in heads if head != last and (noun := "".join((*before, head))) in taxonomy]
    return found if is_noun else found[:1]


def wordings(label: str, taxonomy: Taxonomy) -> list[str]:
    """Return the ways to say what a label says, without spaces, itself first: a printing machine is a printing device.

    Args:
        label: the label, in the singular.
        taxonomy: the nouns.
    """
    *before, last = label.split()
    heads = _ANY_EQUIPMENT if before and last in _ANY_EQUIPMENT else ()
    joined = _alternatives(label.split())
    said = [phrase_of(words, taxonomy) for words in joined] if len(joined) > 1 else []
    return list(
        dict.fromkeys(text.replace(" ", "") for text in (label, *said, *("".join((*before, head)) for head in heads)))
    )


def _alternatives(words: list[str]) -> list[str]:
    """Return what the class of a label with an "or" is made of: cleaning equipment and waste equipment, and waste.

    >>> _alternatives(["cleaning", "and", "waste", "equipment"])
    ['cleaning equipment', 'waste equipment', 'cleaning']
    >>> _alternatives(["newspaper", "or", "magazine"])
    ['newspaper', 'magazine']
    """
    at = next((at for at, word in enumerate(words) if word in {"and", "or"} and 0 < at < len(words) - 1), None)
    if at is None:
        return [" ".join(words)]
    before, behind = words[:at], words[at + 1 :]
    if len(behind) == 1:
        return [" ".join(before), *_alternatives(behind)]
    return [" ".join((*before, behind[-1])), *_alternatives(behind), " ".join(before)]
