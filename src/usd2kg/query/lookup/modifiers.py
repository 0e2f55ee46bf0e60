"""PhraseModifiers: restrict the things of a noun by what stands before or after it."""

import re
from collections.abc import Callable, Iterable, Iterator

from usd2kg.errors import GraphError
from usd2kg.knowledge import word_map, word_set
from usd2kg.query.lookup.amounts import is_amount, read_amount
from usd2kg.query.lookup.body_measures import (
    COMPARED,
    MEASURES,
    SIZE,
    SUPERLATIVES,
    BodyMeasures,
    Measure,
    nearest_of,
)
from usd2kg.query.lookup.colors import COLORS, has_color, has_material, is_material
from usd2kg.query.lookup.directions import find_between
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.prepositions import DIRECTLY, RELATION_OF, preposition_pattern
from usd2kg.query.lookup.related_things import find_related
from usd2kg.query.lookup.things import Things
from usd2kg.query.lookup.word_forms import split_phrase

__all__ = ["PhraseModifiers", "restricts"]

_SIZES = {"big": max, "large": max, "huge": max, "tall": max, "small": min, "little": min, "tiny": min, "short": min}
_COMPARED = re.compile(rf"(?P<first>.+?) (?P<adjective>{'|'.join(COMPARED)}) than (?P<second>.+)")
_NEAREST = (
    re.compile(r"(?P<first>.+?) (?P<which>nearest|closest|furthest|farthest) (?:away )?(?:to |from )?(?P<second>.+)"),
    re.compile(r"(?P<which>nearest|closest) (?P<first>.+?) (?:to|from) (?P<second>.+)"),
)
_WITHIN = re.compile(
    r"(?P<first>.+?) (?P<which>within|closer than|less than|at most|further than|farther than|more than) "
    r"(?P<amount>[\w.]+ ?\w+?) (?:away )?(?:of|to|from|around) (?P<second>.+)"
)
_BETWEEN = re.compile(r"(?P<first>.+?) between (?P<second>.+?) and (?P<third>.+)")
_SAME_PLACE = re.compile(r"(?P<first>.+?) (?P<relation>on|in|inside) same (?P<second>.+?) as (?P<third>.+)")
_RANGE = re.compile(
    r"(?P<first>.+?) (?:that )?(?P<verb>weigh|weighs|weighing|measure|measures|measuring|with|of|is|are)? ?"
    r"(?:an? |the )?(?:(?P<noun>height|width|length|depth|weight|mass)(?: of)? )?"
    r"between (?P<low>[\d.]+)(?: ?(?P<unit>[a-z]+))? and (?P<high>[\d.]+ ?[a-z]+)(?: (?:in )?(?P<measure>[a-z]+))?"
)
_BEYOND = frozenset({"further than", "farther than", "more than"})
_FOR_PURPOSE = re.compile(r"(?P<first>.+?) (?:to|for) (?P<verb>\w+)(?: (?:up|down))?(?: (?:on|in|with|from|into|at))?")
_WITH_NOTHING = re.compile(
    r"(?P<first>.+?) (?:(?:that )?(?:with|have|has) )?nothing (?:on|in|inside|on top)(?: of)?(?: (?:it|them|top))?"
)
_WITHOUT = re.compile(
    r"(?P<first>.+?) (?:without|with no|that (?:have|has) no) (?:any )?(?P<second>.+?)"
    r"(?: (?:on|in|inside) (?:it|them|top))?"
)
_WITH = re.compile(
    r"(?P<first>.+?) (?:with|that (?:have|has)) (?P<second>.+?) (?P<relation>on|in|inside|near) (?:it|them|top)"
)
_NOT = re.compile(r"(?P<first>.+?) (?:that (?:is|are) )?not (?P<rest>.+)")
_LINKED = re.compile(rf"{DIRECTLY}|(?:{preposition_pattern()}|{'|'.join(COMPARED)}|within|between)\b")
"""Begins a modifier after a noun."""
_EMPTY = word_set("query", "empty_adjectives")

_Find = Callable[[str], Things | None]


def restricts(adjective: str) -> bool:
    """Return whether a word before a noun names a size, a colour, a material or a state that a thing has or lacks."""
    return adjective in {*COLORS, *_SIZES, *_EMPTY, *SUPERLATIVES} or is_material(adjective)


class PhraseModifiers:
    """Reads the modifiers of noun phrases about one graph."""

    def __init__(self, facts: SceneFacts, find: _Find, find_noun: _Find) -> None:
        """Wrap the facts of a graph.

        Args:
            facts: the graph.
            find: returns what a phrase means, None if a word is unknown.
            find_noun: as `find`; a compound that the lexicon lacks may be read as its head, which is noted.
        """
        self._facts = facts
        self._find = find
        self._find_noun = find_noun
        self._bodies = BodyMeasures(facts)

    def read_first(self, text: str) -> Things | None:
        """Return the things of a noun with a modifier that has a preposition: a distance, or what is not on them."""
        readers = (
            self._read_not,
            self._read_superlative,
            self._read_with,
            self._read_without,
            self._read_range,
            self._read_within,
            self._read_nearest,
            self._read_between,
            self._read_same,
        )
        return next((found for read in readers if (found := read(text)) is not None), None)

    def _read_not(self, text: str) -> Things | None:
        """Return the things of a noun that are not of another kind, or to which a modifier does not apply."""
        parts = _NOT.fullmatch(text)
        first = self._find_noun(parts["first"]) if parts is not None else None
        if parts is None or first is None:
            return None
        rest = " ".join(split_phrase(parts["rest"]))
        is_kind = not (_LINKED.match(rest) or restricts(rest))
        denied = self._find(rest if is_kind else f"{rest} {first.text}" if restricts(rest) else f"{first.text} {rest}")
        if denied is None:
            return None
        kept = tuple(iri for iri in first.iris if iri not in denied.iris)
        # A table that is not a bag, a kettle that is no pot: the negation may belong to another noun.
        return None if is_kind and len(kept) in {0, len(first.iris)} else Things(kept, text)

    def _read_superlative(self, text: str) -> Things | None:
        """Return the things of a noun after a superlative with the most or the least of a measure: `largest shelf`."""
        adjective, _, rest = text.partition(" ")
        things = self._find(rest) if rest and adjective in SUPERLATIVES else None
        if things is None:
            return None
        measure, sign = SUPERLATIVES[adjective]
        values = self._measured(things, measure)
        best = max((sign * value for value in values.values()), default=0.0)
        return Things(tuple(iri for iri in things.iris if iri in values and sign * values[iri] == best), text)

    def read(self, text: str) -> Things | None:
        """Return the things of a noun with another modifier; None if there is none, or a word is unknown."""
        readers = (
            self._read_adjective,
            self._read_comparison,
            self._read_purpose,
        )
        return next((found for read in readers if (found := read(text)) is not None), None)

    def find_for_purpose(self, verb: str) -> Things | None:
        """Return the things that an activity needs, or whose kind names it: sports equipment; None if unknown."""
        # Cut bread: the verb says what is needed, or the verb with its particle: put out a fire.
        phrasal, needs = " ".join(verb.split()[:2]).lower(), word_map("query", "activity_things")
        verb = phrasal if phrasal in needs else verb.split(maxsplit=1)[0]
        for noun in filter(None, needs.get(verb.lower(), "").split("/")):
            needed = self._find(noun)
            if needed is not None and needed.iris:
                return Things(needed.iris, f"things to {verb.lower()}")
        word = word_map("query", "purpose_verbs").get(verb.lower(), verb.lower())
        kinds = [word, *(f"{word} {noun}" for noun in sorted(word_set("query", "purpose_nouns")))]
        found = [things for kind in kinds if (things := self._find(kind)) is not None and not things.is_by_name]
        if not any(things.iris for things in found):
            return None
        return Things(tuple(self._facts.sorted({iri for things in found for iri in things.iris})), f"things for {word}")

    def _read_adjective(self, text: str) -> Things | None:
        """Return the things of a noun after a size, a colour, a material, or the word that nothing is in or on them."""
        adjective, _, rest = text.partition(" ")
        if not rest or adjective in SUPERLATIVES or not restricts(adjective):
            return None
        things = self._find(rest)
        if things is None:
            return None
        if adjective in _SIZES:
            sizes = {iri: max(self._facts.body(iri).extents or (0.0,)) for iri in things.iris}
            return Things((_SIZES[adjective](sizes, key=lambda iri: sizes[iri]),) if sizes else (), text)
        return Things(tuple(self._having(adjective, things.iris)), text)

    def _having(self, adjective: str, iris: Iterable[str]) -> Iterator[str]:
        facts = self._facts
        for iri in iris:
            if adjective in _EMPTY:
                held = (find_related(facts, name, [iri], is_direct=True) for name in ("on", "inside"))
                is_so = not any(held)
            elif adjective in COLORS:
                is_so = has_color(facts, iri, adjective)
            else:
                is_so = has_material(facts, iri, adjective)
            if is_so:
                yield iri

    def _read_comparison(self, text: str) -> Things | None:
        """Return the things that have more or less of a measure than each of others, or than an amount."""
        parts = _COMPARED.fullmatch(text)
        first = self._find(parts["first"]) if parts is not None else None
        if parts is None or first is None:
            return None
        measure, sign = COMPARED[parts["adjective"]]
        if is_amount(parts["second"]):
            limit, unit = read_amount(parts["second"])
            if measure is SIZE or unit != measure.unit:
                adjective = parts["adjective"]
                raise GraphError(
                    f"{parts['second']!r} does not measure what is {adjective}; expected a number with {measure.unit}"
                )
            others: tuple[str, ...] = ()
        else:
            second = self._find(parts["second"])
            if second is None:
                return None
            if not second.iris:
                raise GraphError(second.absence)
            limit, others = max(sign * value for value in self._measured(second, measure).values()), second.iris
            limit *= sign
        values = self._measured(first, measure)
        chosen = (iri for iri in first.iris if iri in values and sign * values[iri] > sign * limit)
        return Things(tuple(iri for iri in chosen if iri not in others), text)

    def _read_with(self, text: str) -> Things | None:
        """Return the things that have others on, in or near them: `table with a cup on it`."""
        parts = _WITH.fullmatch(text)
        words = " ".join(split_phrase(parts["second"])) if parts else ""
        if parts is None or words.split(maxsplit=1)[:1] in (["no"], ["nothing"]):
            return None
        first, second = self._find_noun(parts["first"]), self._find(words)
        if first is None or second is None:
            return None
        targets, name = set(second.iris), RELATION_OF[parts["relation"]]
        found = (iri for iri in first.iris if find_related(self._facts, name, [iri], is_direct=False) & targets)
        return Things(tuple(found), text)

    def _read_without(self, text: str) -> Things | None:
        """Return the things that have nothing, or none of others, on or in them or as a part."""
        if nothing := _WITH_NOTHING.fullmatch(text):
            first = self._find(nothing["first"])
            return None if first is None else Things(tuple(self._having("empty", first.iris)), text)
        parts = _WITHOUT.fullmatch(text)
        first, second = (self._find_noun(parts[name]) for name in ("first", "second")) if parts else (None, None)
        if first is None or second is None:
            return None
        related = ("on", "inside", "attached", "part")
        having = {
            iri
            for iri in first.iris
            for name in related
            if not self._facts.related(name, iri).isdisjoint(second.iris)
            or not set(self._facts.anchors(name, iri)).isdisjoint(second.iris)
        }
        note = "" if having else f"“without {second.text}” excludes nothing"
        return Things(tuple(iri for iri in first.iris if iri not in having), text, note)

    def _read_within(self, text: str) -> Things | None:
        """Return the things up to a distance from others, or beyond: `chairs within 2 m of the desk`."""
        parts = _WITHIN.fullmatch(text)
        first, second = (self._find(parts[name]) for name in ("first", "second")) if parts else (None, None)
        if parts is None or first is None or second is None:
            return None
        limit, unit = read_amount(parts["amount"])
        if unit != "m":
            raise GraphError(f"{parts['amount']!r} is not a distance; expected a length, such as 2 m")
        if not second.iris:
            raise GraphError(second.absence)
        gaps = self._bodies.gaps(first.iris, second.iris)
        is_beyond = parts["which"] in _BEYOND
        return Things(tuple(iri for iri, gap in gaps.items() if (gap > limit) is is_beyond), text)

    def _read_range(self, text: str) -> Things | None:
        """Return the things of a noun with a measure from one amount to another: things that weigh 5 to 10 kg."""
        parts = _RANGE.fullmatch(text)
        first = self._find(parts["first"]) if parts is not None else None
        if parts is None or first is None:
            return None
        high, unit = read_amount(parts["high"])
        low, _ = read_amount(f"{parts['low']} {parts['unit'] or parts['high'].lstrip('0123456789. ')}")
        word = parts["measure"] or parts["noun"] or ("weight" if unit == "kg" else "")
        measure = MEASURES.get(word)
        if measure is None or measure is SIZE or measure.unit != unit:
            raise GraphError(f"{text!r} does not say which measure is meant; expected a range such as 1 to 2 m wide")
        values = self._measured(first, measure)
        return Things(tuple(iri for iri in first.iris if iri in values and low <= values[iri] <= high), text)

    def _read_nearest(self, text: str) -> Things | None:
        """Return the thing of a noun with the least or largest gap to others: `chair nearest to the desk`."""
        for pattern in _NEAREST:
            parts = pattern.fullmatch(text)
            first, second = (self._find(parts[name]) for name in ("first", "second")) if parts else (None, None)
            if first is None or second is None:
                continue
            if not second.iris:
                raise GraphError(second.absence)
            # Tablets are computers, and one asks for the tablet nearest to the computer.
            others = [iri for iri in second.iris if iri not in first.iris] or second.iris
            gaps = self._bodies.gaps(first.iris, others)
            sign = -1 if parts is not None and parts["which"] in {"furthest", "farthest"} else 1
            return Things(tuple(self._facts.sorted(nearest_of(gaps, sign))), text)
        return None

    def _read_between(self, text: str) -> Things | None:
        """Return the things of a noun that are between two others: `racks between shelf a and shelf b`."""
        parts = _BETWEEN.fullmatch(text)
        found = [self._find(parts[name]) for name in ("first", "second", "third")] if parts is not None else []
        if not found or any(things is None for things in found):
            return None
        first, *ends = [things for things in found if things is not None]
        pairs = [(one, other) for one in ends[0].iris for other in ends[1].iris if one != other]
        if len(pairs) != 1:
            raise GraphError(f"{text!r} has {len(pairs)} pairs of ends; expected the name of one thing each")
        between = find_between(self._facts, *pairs[0]) or ()
        return Things(tuple(iri for iri in first.iris if iri in between), text)

    def _read_same(self, text: str) -> Things | None:
        """Return the things that are on or in the same thing as others: `cube on same desk as camera`."""
        parts = _SAME_PLACE.fullmatch(text)
        found = [self._find_noun(parts[name]) for name in ("first", "second", "third")] if parts is not None else []
        if parts is None or any(things is None for things in found):
            return None
        first, places, others = [things for things in found if things is not None]
        name, held = RELATION_OF[parts["relation"]], set(others.iris)
        around = [find_related(self._facts, name, [place], is_direct=False) for place in places.iris]
        chosen = {iri for together in around if together & held for iri in together} - held
        return Things(tuple(iri for iri in first.iris if iri in chosen), text)

    def _read_purpose(self, text: str) -> Things | None:
        """Return the things of a noun that are for a purpose: `something to sit on`."""
        parts = _FOR_PURPOSE.fullmatch(text)
        first = self._find(parts["first"]) if parts is not None else None
        meant = self.find_for_purpose(parts["verb"]) if parts is not None and first is not None else None
        if first is None or meant is None or not meant.iris:
            return None
        return Things(tuple(iri for iri in first.iris if iri in meant.iris), text)

    def _measured(self, things: Things, measure: Measure) -> dict[str, float]:
        """Return the measure of each thing that has it, at least one.

        Raises:
            GraphError: none has it.
        """
        values = self._bodies.values(things.iris, measure)
        if not values and things.iris:
            raise self._bodies.unmeasured(things, measure)
        return values
