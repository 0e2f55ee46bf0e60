"""Nouns: from words in a question to objects of the graph."""

import os.path
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property

from rapidfuzz import fuzz, process

from usd2kg.assistant.colors import COLORS, has_color, has_material, is_material
from usd2kg.assistant.facts import SceneFacts
from usd2kg.assistant.sentences import IRREGULAR_PLURALS
from usd2kg.assistant.settings import WORDS
from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_set
from usd2kg.languages import translate
from usd2kg.words import split_identifier

__all__ = ["Nouns", "Things", "UnknownWordError"]

_FILLERS = word_set("assistant", "determiners")
_EVERYTHING = word_set("assistant", "general_nouns")
_QUESTION_WORDS = word_set("assistant", "question_words")
_AREAS = word_set("assistant", "area_nouns")
_LANGUAGES = ("de", "fr", "es", "it")
_SIZES = {"big": max, "large": max, "huge": max, "tall": max, "small": min, "little": min, "tiny": min, "short": min}
_RELATIONS = {
    "on top of": "on",
    "on": "on",
    "upon": "on",
    "inside of": "inside",
    "inside": "inside",
    "in": "inside",
    "within": "inside",
    "next to": "near",
    "beside": "near",
    "near": "near",
    "by": "near",
    "at": "near",
    "above": "above",
    "over": "above",
    "attached to": "attached",
    "mounted on": "attached",
    "hanging on": "attached",
    "from": "inside",
}
_IRREGULAR = {many: one for one, many in IRREGULAR_PLURALS.items()}
_RELATION = re.compile(rf"(?P<first>.+?) (?:that (?:is|are) )?(?P<relation>{'|'.join(_RELATIONS)}) (?P<second>.+)")


class UnknownWordError(GraphError):
    """A word is neither a name in the graph nor a noun that the lexicon knows."""


@dataclass(frozen=True)
class Things:
    """The objects that words mean; none if the words are understood and no object is meant."""

    iris: tuple[str, ...]
    text: str
    """The words, without articles."""
    note: str = ""
    """How unusual words were read; empty if as they are."""

    @property
    def suffix(self) -> str:
        """The note, to be added to a sentence."""
        return f" ({self.note})" if self.note else ""


class Nouns:
    """Resolves noun phrases in the words of people, with the lexicon that grounded the scene."""

    def __init__(self, facts: SceneFacts) -> None:
        self._facts = facts
        self.is_english = True
        """Whether the question is in English; else a word that two languages have may be foreign."""

    def find(self, text: str) -> Things:
        """Return the objects that a noun phrase means.

        Criteria in order: prim path; label; class or concept, with everything below it; all words in the label; a place
        in the prim path and the rest; relations (`cups on the table`); colours, materials and sizes before a noun; the
        asset; other languages; spelling.

        Raises:
            UnknownWordError: a word is not understood; the message has the nearest ones.
        """
        words = _strip(text)
        if not words:
            raise UnknownWordError("the question names no thing; expected a noun, such as table")
        if foreign := [word for word in words if word in _QUESTION_WORDS]:
            raise UnknownWordError(f"{foreign[0]!r} is not understood in a name")
        found = self._find(" ".join(words))
        if found is not None and found.iris:
            return found
        for language in (None,) if self.is_english else _LANGUAGES:
            if (english := translate(tuple(words), language)) and set(english) != set(words):
                translated = self._find(" ".join(english))
                if translated is not None and translated.iris:
                    return replace(translated, note=f"“{' '.join(words)}” was read as “{' '.join(english)}”")
        return found or self._correct(words)

    def _find(self, text: str) -> Things | None:
        """Return what a phrase means as it is written; None if a word is unknown."""
        if text in _EVERYTHING:
            return Things(tuple(self._facts.things), "thing")
        if found := self._named(text):
            return Things(tuple(found), text)
        restricted = self._restricted(text) or self._modified(text)
        if restricted is not None:
            return restricted
        # The noun is known, and no object is one.
        return Things((), text) if _is_noun(text) else None

    def _named(self, text: str) -> list[str]:
        """Return the objects with this name, of this kind, or with these words, by the first criterion with a match."""
        lower, words = text.lower(), _stems(text)
        objects = self._facts.objects.values()
        criteria: tuple[Callable[[], Iterable[str]], ...] = (
            lambda: (one.iri for one in objects if one.path.lower() == lower),
            lambda: (one.iri for one in objects if lower in {one.label.lower(), one.path.lower().rpartition("/")[2]}),
            lambda: (one.iri for one in objects if len(words) > 1 and words == _stems(one.label)),
            lambda: self._main_of_group(lower),
            lambda: self._in_place(text) if self._is_plain(text) else (),
            lambda: self._of_kind(text),
            lambda: (one.iri for one in objects if words and words <= _stems(one.label)),
            lambda: self._in_place(text),
            lambda: (iri for iri, names in self._assets.items() if words and any(words <= _stems(n) for n in names)),
        )
        for criterion in criteria:
            if found := self._facts.sorted(criterion()):
                return found
        return []

    def _of_kind(self, text: str) -> set[str]:
        """Return the objects of a class or concept. A confident object wins over a doubtful one."""
        facts, wanted = self._facts, _stems(text)
        classes = {iri for iri, label in facts.class_labels.items() if _stems(label) == wanted}
        classes = facts.below(classes, "rdfs:subClassOf")
        named = {iri for iri, label in facts.concept_labels.items() if _stems(label) == wanted}
        *before, last = text.split()
        singular = " ".join([*before, _singular(last)])
        concepts = facts.below({*concepts_named(text), *concepts_named(singular), *named}, "skos:broader")
        found = {iri for iri, own in facts.classes.items() if not own.isdisjoint(classes)}
        found |= {iri for iri, concept in facts.concepts.items() if concept in concepts}
        sure = {iri for iri in found if facts.confidences.get(iri, 1.0) >= WORDS.min_confidence}
        return sure or found

    def _in_place(self, text: str) -> set[str]:
        """Return the objects of a kind below a group that the words before the noun name: dining chairs."""
        words = text.split()
        for start in range(1, len(words)):
            place = _stems(" ".join(words[:start]))
            kind = self._of_kind(" ".join(words[start:]))
            if found := {iri for iri in kind if iri in self._facts.objects and place <= _stems(self._group(iri))}:
                return found
        return set()

    def _is_plain(self, text: str) -> bool:
        """Return whether the words before a noun do not make another kind: a dining chair is a chair."""
        *before, last = text.split()
        head = _singular(last)
        return bool(before) and not set(concepts_named(" ".join([*before, head]))).isdisjoint(concepts_named(head))

    def _main_of_group(self, name: str) -> set[str]:
        """Return the objects of the kind that a group is named after: the desk of Desk_A1."""
        grouped = {iri for iri, one in self._facts.objects.items() if name in one.path.lower().split("/")[2:-1]}
        if not grouped:
            return set()
        noun = " ".join(word for word in split_identifier(name) if word.isalpha() and len(word) > 1)
        return (self._of_kind(noun) & grouped) or grouped

    def in_area(self, text: str) -> set[str]:
        """Return the objects below the groups that are named after a place: the reception area."""
        words = _stems(" ".join(word for word in _strip(text) if word not in _AREAS))
        return {iri for iri in self._facts.things if words and words <= _stems(self._group(iri))}

    def _group(self, iri: str) -> str:
        """Return the path of the groups of an object, without the root that all share."""
        return self._facts.objects[iri].path.rpartition("/")[0].removeprefix(self._root)

    @cached_property
    def _root(self) -> str:
        groups = (one.path.rpartition("/")[0] for one in self._facts.objects.values())
        return os.path.commonpath([group for group in groups if group] or ["/"])

    def _restricted(self, text: str) -> Things | None:
        """Return the things that stand in a relation to others: `cups on the table`."""
        parts = _RELATION.fullmatch(text)
        if parts is None:
            return None
        first = self._find(" ".join(_strip(parts["first"])))
        if first is None:
            return None
        near = self.around(_RELATIONS[parts["relation"]], parts["second"], is_direct=False)
        return Things(tuple(iri for iri in first.iris if iri in near), text)

    def around(self, relation: str, text: str, *, is_direct: bool) -> set[str]:
        """Return the objects in a relation to the things that a noun phrase means, or in a part of the scene.

        Raises:
            GraphError: there are no such things.
        """
        try:
            anchors = self.find(text)
        except UnknownWordError:
            if relation != "inside" or not (area := self.in_area(text)):
                raise
            return area
        found = self.related(relation, anchors.iris, is_direct=is_direct)
        if relation == "inside" and not found and (area := self.in_area(text)):
            return area
        if not anchors.iris:
            raise GraphError(f"there is no {anchors.text} in this scene{anchors.suffix}")
        return found

    def related(self, relation: str, anchors: Iterable[str], *, is_direct: bool) -> set[str]:
        """Return the objects in a relation to any of some anchors; if not direct, also those on or in these objects."""
        facts = self._facts
        found: set[str] = set()
        waiting = [*anchors]
        names = [relation] if is_direct or relation not in {"on", "inside"} else ["on", "inside"]
        first = {iri for anchor in waiting for iri in facts.related(relation).get(anchor, ())}
        if is_direct or relation not in {"on", "inside"}:
            return first
        waiting = [*first]
        while waiting:
            iri = waiting.pop()
            if iri not in found:
                found.add(iri)
                waiting.extend(one for name in names for one in facts.related(name).get(iri, ()))
        return found

    def _modified(self, text: str) -> Things | None:
        """Return the things of a noun after an adjective: a colour, a material, or a size."""
        adjective, _, rest = text.partition(" ")
        if not rest or not (adjective in COLORS or adjective in _SIZES or is_material(adjective)):
            return None
        things = self._find(rest)
        if things is None:
            return None
        if adjective in _SIZES:
            sizes = {iri: max(self._facts.body(iri).extents or (0.0,)) for iri in things.iris}
            chosen = [_SIZES[adjective](sizes, key=lambda iri: sizes[iri])] if sizes else []
        elif adjective in COLORS:
            chosen = [iri for iri in things.iris if has_color(self._facts, iri, adjective)]
        else:
            chosen = [iri for iri in things.iris if has_material(self._facts, iri, adjective)]
        return Things(tuple(chosen), text)

    def _correct(self, words: list[str]) -> Things:
        """Return what is meant if one spelling is much more likely than all others.

        Raises:
            UnknownWordError: no spelling, or several, are near.
        """
        unknown = [word for word in words if not self._is_known(word)] or words
        corrected, nearest = list(words), []
        for word in unknown:
            similar = process.extract(
                word, self._vocabulary, scorer=fuzz.ratio, score_cutoff=WORDS.min_similarity, limit=3
            )
            nearest += [name for name, _, _ in similar]
            if similar and (len(similar) == 1 or similar[0][1] > similar[1][1]) and len(word) >= WORDS.min_letters:
                corrected[words.index(word)] = similar[0][0]
        if corrected != words and (found := self._find(" ".join(corrected))) is not None and found.iris:
            return replace(found, note=f"“{' '.join(words)}” was read as “{' '.join(corrected)}”")
        advice = f"; did you mean {' or '.join(dict.fromkeys(nearest))}?" if nearest else ""
        shown = " ".join(unknown)
        raise UnknownWordError(
            f"{shown!r} is not understood{advice}"
            if advice
            else f"{shown!r} is not a word that this graph or the lexicon knows"
        )

    def _is_known(self, word: str) -> bool:
        return word in _RELATIONS or word in _FILLERS or _is_noun(word) or bool(_stems(word) & self._stems_in_use)

    @cached_property
    def _stems_in_use(self) -> frozenset[str]:
        return frozenset(stem for word in self._vocabulary for stem in _stems(word))

    @cached_property
    def _vocabulary(self) -> list[str]:
        """The words of names, classes and concepts of the graph."""
        facts = self._facts
        texts = [one.label for one in facts.objects.values()]
        texts += [*facts.class_labels.values(), *facts.concept_labels.values()]
        words = {word.lower() for text in texts for word in split_identifier(text)}
        return sorted(word for word in words if word.isalpha() and len(word) >= WORDS.min_letters)

    @cached_property
    def _assets(self) -> dict[str, list[str]]:
        found: dict[str, list[str]] = {}
        for row in self._facts.graph.dataset.select("SELECT ?s ?v { ?s u2k:primPath [] ; u2k:asset ?v }"):
            found.setdefault(str(row["s"].value), []).append(str(row["v"].value))
        return found


def _strip(text: str) -> list[str]:
    """Return the words of a noun phrase without articles and words that add nothing."""
    words = re.sub(r"\b(that|which) (is|are) ", "", text.strip(" ?!.,;"), flags=re.IGNORECASE).split()
    while words and words[0].lower() in _FILLERS:
        words = words[1:]
    while len(words) > 1 and words[-1].lower() in {"here", "there", "please"}:
        words = words[:-1]
    cleaned = " ".join(words)
    for tail in (" in here", " in this scene", " in the scene"):
        cleaned = cleaned.removesuffix(tail)
    return [
        word if "/" in word or "_" in word else word.lower()
        for word in cleaned.split()
        if word.lower() not in {"the", "a", "an"}
    ]


def _stems(text: str) -> frozenset[str]:
    return frozenset(_singular(word.lower()) for word in split_identifier(text) if not word.isdigit())


def _singular(word: str) -> str:
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    for ending, singular in (("ves", "f"), ("ies", "y"), ("sses", "ss"), ("xes", "x"), ("fe", "f"), ("s", "")):
        if word.endswith(ending) and len(word) > len(ending) + 2 and not word.endswith("ss"):
            return word.removesuffix(ending) + singular
    return word


def _is_noun(text: str) -> bool:
    """Return whether the lexicon knows a noun, or all words of a compound."""
    return bool(text) and bool(concepts_named(text) or all(concepts_named(_singular(word)) for word in text.split()))
