"""PlaceNouns: nouns for the whole scene and for parts of it that are no things."""

from collections.abc import Collection

from usd2kg.knowledge import word_set
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.kinds import Kinds
from usd2kg.query.lookup.names import NameMatcher
from usd2kg.query.lookup.related_things import find_related
from usd2kg.query.lookup.word_forms import is_place, noun_words, split_phrase

__all__ = ["PlaceNouns"]

_EVERYTHING = word_set("query", "general_nouns")
_FLOORS = word_set("query", "floors")
_ROOM_NOUNS = word_set("query", "room_nouns")


class PlaceNouns:
    """Tells which nouns mean places of one graph."""

    def __init__(self, facts: SceneFacts) -> None:
        self._facts = facts
        self._kinds = Kinds(facts)
        self._names = NameMatcher(facts, self._kinds)

    def is_everything(self, text: str) -> bool:
        """Return whether a noun means any thing."""
        return " ".join(split_phrase(text)) in _EVERYTHING

    def is_floor(self, text: str) -> bool:
        """Return whether a noun means what heights are measured from."""
        return " ".join(split_phrase(text)) in _FLOORS

    def of_kind(self, noun: str) -> set[str]:
        """Return the objects of the kind that a noun names, whatever their names are."""
        return self._kinds.objects(noun)

    def in_area(self, text: str) -> set[str]:
        """Return the objects below the groups that are named after a place: the reception area."""
        return self._names.in_area(text)

    def is_area(self, text: str, iris: Collection[str]) -> bool:
        """Return whether objects are of the group with the name of a text, and most hold nothing: it is a place."""
        holders = [iri for iri in iris if find_related(self._facts, "inside", [iri], is_direct=True)]
        return bool(iris) and 2 * len(holders) < len(iris) and set(iris) <= self._names.in_area(text)

    def lacks_room(self, text: str) -> bool:
        """Return whether a noun means a room that the graph does not have."""
        noun = " ".join(split_phrase(text))
        return noun in _ROOM_NOUNS and not self._kinds.objects(noun) and not self._names.in_area(noun)

    def is_whole_scene(self, text: str) -> bool:
        """Return whether a noun means the scene: the shop, or the room where the graph has none."""
        is_scene = is_place(text) or (text.isalpha() and text in noun_words(self._names.root))
        is_part = bool(self._kinds.objects(text) or self._names.in_area(text))
        return is_scene and not is_part and not (text == "room" and self._facts.rooms)

    def is_group(self, text: str) -> bool:
        """Return whether a noun means a place of which the graph only has the things in it, as a group."""
        is_named = text in _ROOM_NOUNS or is_place(text)
        return is_named and not self._kinds.objects(text) and bool(self._names.in_area(text))
