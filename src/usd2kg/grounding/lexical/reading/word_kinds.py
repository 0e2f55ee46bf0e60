"""Kind of a word in a name: modifier, material, place or noun, or unknown."""

from functools import lru_cache

from usd2kg.grounding.lexical.alignment.lexicon import Lexicon
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.grounding.lexical.reading.name_bigrams import load_name_bigrams
from usd2kg.grounding.lexical.settings import MODIFIER
from usd2kg.knowledge import word_set

__all__ = ["AREAS", "PLACEMENTS", "THING_DOMAINS", "WordKinds"]

PLACEMENTS = word_set("lexical", "placements")
AREAS = word_set("lexical", "areas")
_MODIFYING_DOMAINS = frozenset({"substance", "shape", "phenomenon", "top"})
"""WordNet domains of materials, colours and shapes."""
_CONTENT_DOMAINS = frozenset({"food", "plant"})
"""WordNet domains of contents and flavours."""
_PHYSICAL_DOMAINS = frozenset({"artifact", "food", "plant", "animal", "person", "substance", "object", "shape"})
THING_DOMAINS = frozenset({"artifact", "food"})
"""WordNet domains of objects that are often in scenes."""


class WordKinds:
    """Kinds of words, for one lexicon and the taxonomy."""

    def __init__(self, lexicon: Lexicon, taxonomy: Taxonomy) -> None:
        self._lexicon = lexicon
        self._taxonomy = taxonomy
        # Names repeat the same words.
        self.is_modifier = lru_cache(maxsize=16384)(self._is_modifier)
        self.is_place = lru_cache(maxsize=16384)(self._is_place)
        self._modifier_share = lru_cache(maxsize=16384)(self._compute_modifier_share)
        self._is_material = taxonomy.below(word_set("lexical", "material_hypernyms"))
        self._is_substance = taxonomy.below(word_set("lexical", "substance_hypernyms"))
        self._is_kind_of_place = taxonomy.below(word_set("lexical", "place_hypernyms"))

    def is_known(self, word: str) -> bool:
        """Return whether a word is a term of the TBox, or a noun, adjective or participle."""
        return (
            word in self._lexicon.terms
            or word in self._lexicon.vocabulary
            or word in self._taxonomy
            or self._is_adjective(word)
        )

    def _is_adjective(self, word: str) -> bool:
        return word in PLACEMENTS or word in self._taxonomy.adjectives or self._is_participle(word)

    def _is_participle(self, word: str) -> bool:
        """Return whether a word looks like a participle of a known noun, without being a noun: `lidded`, `docking`."""
        ending = next((ending for ending in ("ed", "ing") if word.endswith(ending)), "")
        if not ending or len(word) < MODIFIER.min_participle_letters or word in self._taxonomy:
            return False
        stem = word.removesuffix(ending)
        stems = {stem, stem + "e", stem[:-1] if stem[-1] == stem[-2] else stem, stem[:-1] + "y"}
        return any(noun in self._taxonomy for noun in stems)

    def _is_modifier(self, word: str) -> bool:
        """Return whether a word describes an object rather than naming it, even at the end of a name."""
        if word in self._lexicon.terms:
            return False
        if self._is_adjective(word):
            return True
        senses = self._taxonomy.senses(word)
        return bool(senses) and all(sense.domain in _MODIFYING_DOMAINS for sense in senses)

    def is_noun(self, word: str) -> bool:
        """Return whether a word is a noun of the taxonomy."""
        return word in self._taxonomy

    def modifier_share(self, word: str, *, is_last: bool = True) -> float:
        """Return the probability that a word behind the head noun only modifies it: `table_oak`.

        By the first physical sense: highest for adjectives, materials, colours and shapes, lower for codes, flavours,
        places and other objects. Before the last word only the first group modifies.
        """
        share = self._modifier_share(word)
        return share if is_last or share == MODIFIER.adjective_share else 0.0

    def _compute_modifier_share(self, word: str) -> float:
        if self._is_adjective(word):
            return MODIFIER.adjective_share
        senses = self._taxonomy.senses(word)
        if not senses:
            return MODIFIER.object_share if word in self._lexicon.terms else MODIFIER.code_share
        first = next((sense for sense in senses if sense.domain in _PHYSICAL_DOMAINS), senses[0])
        if first.domain in _MODIFYING_DOMAINS or self._is_material(first.synset):
            return MODIFIER.adjective_share
        if first.domain in _CONTENT_DOMAINS:
            return MODIFIER.content_share
        return MODIFIER.place_share if self.is_place(word) else MODIFIER.object_share

    def _is_place(self, word: str) -> bool:
        """Return whether a word means a room, a building or an area in its usual sense."""
        sense = usual_sense(word, self._taxonomy)
        return word in AREAS or (sense is not None and self._is_kind_of_place(sense.synset))

    def may_modify_parent(self, word: str) -> bool:
        """Return whether a word beside those of the parent's name may only modify them: a `desk_oak` below `Desk`.

        Substances do, unless objects are often named after them.
        """
        if self.is_modifier(word):
            return True
        is_substance = self._modifier_share(word) >= MODIFIER.code_share or any(
            self._is_substance(sense.synset) for sense in self._taxonomy.senses(word)
        )
        is_name = word in _single_home_names() and load_name_bigrams().odds_of_last(word) <= MODIFIER.max_last_odds
        return is_substance and not is_name

    def is_object(self, word: str) -> bool:
        """Return whether a word is a term of the TBox or a noun for an object that is often in scenes."""
        if word in self._lexicon.terms:
            return True
        senses = self._taxonomy.senses(word)
        has_object_sense = any(
            sense.domain in THING_DOMAINS and sense.rank <= MODIFIER.max_object_rank for sense in senses
        )
        # A plank is a substance in WordNet.
        return has_object_sense or (bool(senses) and senses[0].domain == "substance")


@lru_cache(maxsize=1)
def _single_home_names() -> frozenset[str]:
    return frozenset(name.lower() for names in home_names().values() for name in names if " " not in name)
