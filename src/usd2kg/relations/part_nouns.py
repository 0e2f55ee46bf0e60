"""The concepts that the last noun of a name means: of a compound that names a part, the head is the last noun.

The grounder may take another word for the head, since names of prims often begin with the place or the whole:
`sink_door` has the class of sinks, `drawer_fork` that of drawers.
"""

from functools import lru_cache
from itertools import takewhile
from typing import NamedTuple

from usd2kg.grounding import Grounding, NamingRegime, Status, concepts_named
from usd2kg.relations.thresholds import PartOfRule
from usd2kg.scene import Scene
from usd2kg.words import words_of

__all__ = ["NounConcepts", "find_noun_concepts"]

_MANY_NAMES = 1 << 12


class NounConcepts(NamedTuple):
    """IRIs of the concepts that words of a name mean, with all their hypernyms."""

    usual: frozenset[str] = frozenset()
    """Of the last noun in its usual sense, and of the compound that it makes with the word before; empty for an unknown
    noun."""
    possible: frozenset[str] = frozenset()
    """Of the last noun in any sense."""
    before: frozenset[str] = frozenset()
    """Of the words before it, in their usual senses."""
    is_skeleton: bool = False
    """Whether the last noun means what carries the other parts of a thing: a frame, uprights, a body."""


def find_noun_concepts(scene: Scene, grounding: Grounding, rule: PartOfRule) -> list[NounConcepts]:
    """Return for each object what the nouns of its name mean.

    Nothing where a person chose the class, and where the grounding did not see the names.
    """
    if not _saw_names(grounding):
        return [NounConcepts()] * len(scene.objects)
    directions, faces, forms = frozenset(rule.directions), frozenset(rule.faces), frozenset(rule.forms)
    prepositions, skeletons = frozenset(rule.prepositions), frozenset(rule.skeletons)

    def noun_phrase(name: str) -> tuple[str, ...]:
        words = tuple(takewhile(lambda word: word not in prepositions, words_of(name)))
        while words and words[-1] in directions:
            words = words[:-1]
        return words

    found: list[NounConcepts] = []
    for obj in scene.objects:
        prediction = grounding.by_path.get(obj.prim_path)
        is_decided = prediction is not None and prediction.status is Status.REVIEWED
        group, _, name = obj.prim_path.rpartition("/")
        words = () if is_decided else noun_phrase(name)
        if len(words) == 1 and words[0] in forms:
            # The panel of a group that is named after a door is the door.
            words = noun_phrase(group.rpartition("/")[2]) or words
        known = NounConcepts() if not words or words[-1] in faces else _concepts_of(words)
        found.append(known._replace(is_skeleton=bool(words) and words[-1] in skeletons))
    return found


def _saw_names(grounding: Grounding) -> bool:
    regime = NamingRegime(grounding.settings.get("regime", NamingRegime.SEMANTIC))
    groups = grounding.settings.get("evidence")
    return regime is NamingRegime.SEMANTIC and (not groups or "name" in groups.split(","))


@lru_cache(maxsize=_MANY_NAMES)
def _concepts_of(words: tuple[str, ...]) -> NounConcepts:
    return NounConcepts(
        _usual_concepts(words[-1]) | _usual_concepts(" ".join(words[-2:])),
        _all_concepts(words[-1]),
        frozenset().union(*map(_usual_concepts, words[:-1])),
    )


@lru_cache(maxsize=_MANY_NAMES)
def _usual_concepts(noun: str) -> frozenset[str]:
    return _with_hypernyms(concepts_named(noun)[:1])


@lru_cache(maxsize=_MANY_NAMES)
def _all_concepts(noun: str) -> frozenset[str]:
    return _with_hypernyms(concepts_named(noun))


def _with_hypernyms(iris: tuple[str, ...]) -> frozenset[str]:
    # Imported here, since it reads the noun taxonomy.
    from usd2kg.grounding.lexical.recognition import describe_concepts  # noqa: PLC0415

    return frozenset(describe_concepts(iris))
