"""find_more_general: things whose kind is little more general than a noun that no thing is known to be."""

from usd2kg.grounding import hypernyms_of
from usd2kg.knowledge import word_map
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.modifiers import restricts
from usd2kg.query.lookup.things import Things
from usd2kg.query.lookup.word_forms import singular
from usd2kg.query.settings import WORDS

__all__ = ["find_more_general"]

_INTERCHANGEABLE = word_map("query", "interchangeable")


def find_more_general(facts: SceneFacts, noun: str) -> Things | None:
    """Return the things that may be of a kind although they are known as something more general; None without such.

    The scene has a cooktop; whether it is an induction hob is not known.

    Args:
        facts: the graph.
        noun: a noun that the lexicon knows.
    """
    above = hypernyms_of(noun)
    kinds: dict[str, list[str]] = {}
    for iri in facts.things:
        # A white cup is a cup: its colour is no kind.
        *before, last = facts.kind(iri).split() or [""]
        kinds.setdefault(" ".join([*(word for word in before if not restricts(word)), last]), []).append(iri)
    # People use the name of a near kind: a storage rack is a rack, which is a shelf in the scene.
    named = {kind: kind for kind in above}
    named |= {one: kind for kind in sorted(above & _INTERCHANGEABLE.keys()) for one in _near(kind)}
    shares = {kind: len(hypernyms_of(named[kind]) & above) / len(above) for kind in kinds if kind in named}
    near = [kind for kind, share in shares.items() if share >= WORDS.min_general_share]
    # The head of a compound is always more general.
    head = singular(noun.rsplit(maxsplit=1)[-1])
    for kind in {head, *_near(head)} & kinds.keys() - {noun}:
        shares[kind] = 1.0
        near.append(kind)
    best = max(near, key=lambda kind: (shares[kind], kind), default=None)
    return None if best is None or best == noun else Things(tuple(facts.sorted(kinds[best])), best)


def _near(noun: str) -> list[str]:
    """Return the nouns that people use for another."""
    return list(filter(None, _INTERCHANGEABLE.get(noun, "").split("/")))
