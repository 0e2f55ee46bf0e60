"""What a single word of a name is: whether it describes, names a place or a thing, or is not known at all."""

from functools import lru_cache

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon, home_names
from usd2kg.grounding.lexical.concepts.senses import sense_weight
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.name_bigrams import load_written_names

__all__ = ["AREAS", "PLACEMENTS", "THING_DOMAINS", "WordKinds"]

PLACEMENTS = frozenset(
    """
    top bottom middle mid left right front back rear upper lower inner outer center centre side corner end north
    south east west open closed main big small large long short tall mini new single double half full one two
    three four five six first second third type var variant alt empty used set grey gray beige body assembly part
    stack pile pair bunch heap row scan scanned lowpoly highpoly poly simplified decimated textured
    """.split()
)
_PLACES = frozenset(["room", "building", "passageway", "land", "location", "tract", "facility", "establishment"])
AREAS = frozenset(["area", "zone", "section", "region", "exit"])
"""Places within a room: the drawer in the `sink_area_drawer`, the sign of an `exit_sign`."""
_MATERIALS = frozenset(["fabric", "cloth", "material", "leather", "paper", "ceramic ware", "ceramic"])
_STUFFS = frozenset(["metallic element", "alloy", "building material", "wood", "fabric", "material", "coating", "cane"])
"""What things are made of, though it may be the name of a thing too: iron, stone, denim."""
_DESCRIBES, _CODE, _FLAVOUR, _OTHER_THING = 0.93, 0.8, 0.6, 0.15
_PLACE = 0.4
_STUFF_DOMAINS = frozenset({"substance", "shape", "phenomenon", "top"})
_CONTENT_DOMAINS = frozenset({"food", "plant"})
_SOLID_DOMAINS = frozenset({"artifact", "food", "plant", "animal", "person", "substance", "object", "shape"})
THING_DOMAINS = frozenset({"artifact", "food"})
_WOODS = frozenset(["wood"])
_OFTEN = 0.5
"""How many times as often as before other words a word stands last in names that may but describe there."""
_SHORTEST_PARTICIPLE = 5


class WordKinds:
    """Knows the words of one lexicon and the taxonomy."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        # What a word is depends on nothing else, and is asked for over and over.
        self.is_modifier = lru_cache(maxsize=16384)(self._is_modifier)
        self.is_place = lru_cache(maxsize=16384)(self._is_place)
        self._describes = lru_cache(maxsize=16384)(self._describing)
        self._is_material = taxonomy.below(_MATERIALS)
        self._is_wood = taxonomy.below(_WOODS)
        self._is_stuff = taxonomy.below(_STUFFS)
        self._is_kind_of_place = taxonomy.below(_PLACES)

    def is_known(self, word: str) -> bool:
        """Return whether a word is a term of the TBox, or a noun or adjective of the taxonomy."""
        return (
            word in self._lexicon.terms
            or word in self._lexicon.vocabulary
            or word in self._taxonomy
            or word in self._taxonomy.adjectives
            or word in PLACEMENTS
            or self._is_participle(word)
        )

    def _is_participle(self, word: str) -> bool:
        """Return whether a word is no noun and looks like a participle of one that is known: `lidded`, `docking`."""
        ending = next((ending for ending in ("ed", "ing") if word.endswith(ending)), "")
        if not ending or len(word) < _SHORTEST_PARTICIPLE or word in self._taxonomy:
            return False
        stem = word.removesuffix(ending)
        stems = {stem, stem + "e", stem[:-1] if stem[-1] == stem[-2] else stem, stem[:-1] + "y"}
        return any(found in self._taxonomy for found in stems)

    def _is_modifier(self, word: str) -> bool:
        """Return whether a word, at the end of a name, describes and does not say what the thing is."""
        if word in self._lexicon.terms:
            return False
        if word in PLACEMENTS or word in self._taxonomy.adjectives or self._is_participle(word):
            return True
        senses = self._taxonomy.senses(word)
        return bool(senses) and all(sense.domain in _STUFF_DOMAINS for sense in senses)

    def is_noun(self, word: str) -> bool:
        """Return whether the taxonomy knows a word as a noun for something physical."""
        return word in self._taxonomy

    def modifier_share(self, word: str, *, is_last: bool = True) -> float:
        """Return how likely a word, behind the head of a name, does no more than describe: `table_oak`.

        A share of names by the word's first meaning, set by hand: materials, colours and shapes nearly always, codes
        mostly, flavours and places often, other things seldom. Before the last word only the first kind does.
        """
        share = self._describes(word)
        return share if is_last or share == _DESCRIBES else 0.0

    def _describing(self, word: str) -> float:
        if word in PLACEMENTS or word in self._taxonomy.adjectives or self._is_participle(word):
            return _DESCRIBES
        senses = self._taxonomy.senses(word)
        if not senses:
            return _OTHER_THING if word in self._lexicon.terms else _CODE
        first = next((sense for sense in senses if sense.domain in _SOLID_DOMAINS), senses[0])
        is_content = first.domain in _CONTENT_DOMAINS
        # What is called after a tree is made of it sooner than flavoured with its fruit.
        is_wood = is_content and any(self._is_wood(sense.synset) for sense in senses)
        if first.domain in _STUFF_DOMAINS or self._is_material(first.synset) or is_wood:
            return _DESCRIBES
        if is_content:
            return _FLAVOUR
        return _PLACE if self.is_place(word) else _OTHER_THING

    def _is_place(self, word: str) -> bool:
        """Return whether a word stands for a room, a building or an area by its likeliest meaning: a box does not."""
        sense = max(self._taxonomy.senses(word), key=sense_weight, default=None)
        return word in AREAS or (sense is not None and self._is_kind_of_place(sense.synset))

    def may_describe(self, word: str) -> bool:
        """Return whether a word beside those of its parent may but describe: below `Desk` a `desk_oak` is a desk.

        Stuff that things are made of may, but where people call a thing so, and seldom end other names with it.
        """
        if self.is_modifier(word):
            return True
        is_stuff = self._describes(word) >= _CODE or any(
            self._is_stuff(sense.synset) for sense in self._taxonomy.senses(word)
        )
        return is_stuff and (word not in _single_names() or load_written_names().odds_of_last(word) > _OFTEN)

    def is_flavour(self, word: str) -> bool:
        """Return whether a word may tell of what kind something is: what it holds, or is made of or called."""
        return self._describes(word) >= _FLAVOUR

    def names_thing(self, word: str) -> bool:
        """Return whether a word is a term of the TBox or a noun for something that stands in scenes."""
        if word in self._lexicon.terms:
            return True
        # A plank is a substance to WordNet.
        senses = self._taxonomy.senses(word)
        return any(sense.domain in THING_DOMAINS and sense.rank <= 3 for sense in senses) or (
            bool(senses) and senses[0].domain == "substance"
        )


@lru_cache(maxsize=1)
def _single_names() -> frozenset[str]:
    return frozenset(name.lower() for names in home_names().values() for name in names if " " not in name)
