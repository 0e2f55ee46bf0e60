"""paraphrases: other wordings of a question, by the rules in `paraphrases.txt` and the order of its clauses."""

import re
from collections.abc import Iterator

from usd2kg.assistant.phrases import normalize, split_clauses
from usd2kg.assistant.rewording import read_rules, reword

__all__ = ["NOUNS_ONLY", "paraphrases"]


_PAIR = 2
NOUNS_ONLY = re.compile(r"\b(is|are|was|were|be|am|has|have|had|do|does|i|we|you)\b|'", re.IGNORECASE)
"""What a clause has that is more than a noun phrase."""
_OPEN = re.compile(r"(what|which|where|how|is|are)\b(?!.*\b(it|they|them|this|that|one)\b)", re.IGNORECASE)
"""A question without a pronoun for what was named before."""


def paraphrases(text: str) -> Iterator[str]:
    """Yield other wordings of a question, the one nearest to it first.

    Clauses may be in another order: a question about what was named before it ends with that.

    >>> next(paraphrases("Out of all mugs, which one is furthest away from the sink?"))
    'which mugs is furthest from the sink'
    >>> next(paraphrases("on the table, what is there?"))
    'what is there on the table'
    """
    whole = normalize(text)
    clauses = split_clauses(whole)
    ordered = [whole]
    if len(clauses) == _PAIR and NOUNS_ONLY.search(clauses[0]) is None and _OPEN.match(clauses[1]):
        ordered += [f"{clauses[1]} {clauses[0]}"]
    seen = {whole}
    if clauses:
        ordered += [", ".join(map(_reworded, clauses))]
    for one in ordered:
        for other in (_reworded(one), one):
            if other not in seen:
                seen.add(other)
                yield other


def _reworded(text: str) -> str:
    return reword(text, read_rules("paraphrases.txt"))
