"""Filters: what modifiers and predicates say about things, in terms of a graph."""

from collections.abc import Collection, Sequence

from usd2kg.assistant.composition.groups import ANY, Filter, Group, Quantity
from usd2kg.assistant.relation_answers import PREPOSITIONS, RelationAnswers
from usd2kg.errors import GraphError
from usd2kg.query.lookup import Nouns, SceneFacts, UnknownWordError
from usd2kg.query.lookup.body_measures import ELEVATION, MASS, TOP, BodyMeasures, Measure, nearest_of
from usd2kg.query.lookup.colors import COLORS, has_color, has_material, is_material, material_words, own_colors
from usd2kg.query.lookup.directions import find_between
from usd2kg.query.lookup.openable_things import find_openable
from usd2kg.query.lookup.prepositions import SIDES
from usd2kg.query.lookup.related_things import find_over, find_parts, find_related

__all__ = ["EVERYTHING", "Filters", "both", "negated", "then"]

_HELD = ("on", "inside", "attached", "part")
"""Relations of what a thing has."""
_PAIR = 2


class Filters:
    """Makes filters about one graph."""

    def __init__(self, facts: SceneFacts, nouns: Nouns, relations: RelationAnswers) -> None:
        self._facts = facts
        self._nouns = nouns
        self._relations = relations
        self._bodies = BodyMeasures(facts)

    def related(self, relation: str, anchors: Group, *, is_direct: bool = False, is_all: bool = False) -> Filter:
        """Choose what is in a relation to any of others; directly if any things are asked for, unless all are."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            return self._in_relation(relation, anchors.existing(), iris, is_direct=is_direct, is_all=is_all)

        return Filter(choose, anchors.guesses, anchors.cost)

    def _in_relation(
        self,
        relation: str,
        anchors: Sequence[str],
        iris: Sequence[str],
        *,
        is_direct: bool = False,
        is_all: bool = False,
    ) -> set[str]:
        what = None if len(iris) == len(self._facts.things) and not is_all else tuple(iris)
        return self._relations.find_in_relation(relation, tuple(anchors), what, is_direct=is_direct) - set(anchors)

    def rooms_of(self, iri: str) -> Sequence[str]:
        """Return the rooms that a thing is in."""
        return self._facts.anchors("room", iri)

    def between(self, one: Group, other: Group) -> Filter:
        """Choose what is between two things."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            pairs = {frozenset((first, second)) for first in one.existing() for second in other.existing()}
            pairs = {pair for pair in pairs if len(pair) == _PAIR}
            if len(pairs) != 1:
                raise GraphError(f"{one.text!r} and {other.text!r} are {len(pairs)} pairs of things; expected one")
            found = find_between(self._facts, *sorted(pairs.pop()))
            if found is None:
                raise GraphError(f"not known: the graph has no boxes for {one.text} and {other.text}")
            return set(found) & set(iris)

        return Filter(choose, (*one.guesses, *other.guesses), one.cost + other.cost)

    def of_area(self, area: Collection[str]) -> Filter:
        """Choose the objects of a part of the scene."""
        return Filter(lambda iris: [iri for iri in iris if iri in area])

    def carrying(self, relation: str, others: Group) -> Filter:
        """Choose what others are in a relation to: the table that the lamp stands on, directly if anything is."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            wanted, held = set(iris), others.existing()
            if relation == "below":
                return {one for iri in held for one in find_over(self._facts, iri)} & wanted
            if relation not in _HELD:
                # What a thing is on is not what it is behind.
                stated = {one for iri in held for one in self._facts.anchors(relation, iri)} & wanted
                if not stated and relation in SIDES:
                    place = PREPOSITIONS[relation]
                    raise GraphError(f"not known: the graph does not state what the {others.text} is {place}")
                return stated
            names = [relation, *(name for name in (*_HELD, "room") if name != relation)]
            for name in names:
                direct = {one for iri in held for one in self._facts.anchors(name, iri)} & wanted
                if direct:
                    return direct
            if found := {one for iri in held for one in self._holders(iri)} & wanted:
                return found
            if len(iris) == len(self._facts.things):
                return []
            # The burner of the stove that the kettle is on.
            return [
                iri for iri in iris if not find_related(self._facts, relation, [iri], is_direct=False).isdisjoint(held)
            ]

        return Filter(choose, others.guesses, others.cost)

    def _holders(self, iri: str) -> set[str]:
        found, waiting = set[str](), {iri}
        while waiting:
            waiting = {one for held in waiting for name in _HELD for one in self._facts.anchors(name, held)} - found
            found |= waiting
        return found

    def holding(self, others: Group, quantity: Quantity, relation: str = "") -> Filter:
        """Choose what has a number of others in a relation to it, or on it, in it, fixed to it or as a part."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            if not others.noun.iris:
                raise GraphError(others.noun.absence)
            targets = set(others.iris)
            counts = {iri: len((self._held(iri, relation, others) & targets) - {iri}) for iri in iris}
            if not relation and not any(counts.values()):
                self._check_parts(iris, targets)
            if others.is_definite and len(iris) > 1 and not any(counts.values()):
                # Which of them has the lamp? One of them has it.
                raise GraphError(f"not known: none of these things is known to have {others.text}")
            if quantity.is_most:
                most = max(counts.values(), default=0)
                return [iri for iri, count in counts.items() if count == most > 0]
            return [iri for iri, count in counts.items() if quantity.holds(count, len(targets))]

        return Filter(choose, others.guesses, others.cost, is_relative=quantity.is_most)

    def _check_parts(self, iris: Sequence[str], targets: Collection[str]) -> None:
        """Check that things have any parts if none of them has one of a kind.

        Raises:
            GraphError: the graph states no parts of them.
        """
        are_parts = bool(targets) and all(self._facts.anchors("part", iri) for iri in targets)
        if are_parts and not find_parts(self._facts, iris):
            raise GraphError("not known: the graph states no parts of these things as objects of their own")

    def _held(self, iri: str, relation: str, others: Group) -> set[str]:
        if relation in {"near", "below", "above", *SIDES}:
            return self._in_relation(relation, [iri], others.iris, is_direct=True)
        names = [relation] if relation else ["on", "inside"]
        found = {one for name in names for one in find_related(self._facts, name, [iri], is_direct=False)}
        # The table with a tablet in a holder on it has the tablet.
        fixed = find_related(self._facts, "attached", [iri, *find_parts(self._facts, [iri]), *found], is_direct=True)
        # The holder has a tablet that is attached to it, and the tablet has the holder.
        both = set() if relation else {*self._facts.anchors("attached", iri), *self._facts.related("room", iri)}
        return found | fixed | find_parts(self._facts, [iri]) | both

    def without(self, others: Group, relation: str) -> Filter:
        """Choose what has none of others; a note says if that leaves out nothing."""
        having = self.holding(others, ANY, relation)

        def choose(iris: Sequence[str]) -> Collection[str]:
            left_out = set(having.choose(iris))
            if not left_out:
                self._nouns.notes.append(f"“without {others.text}” excludes nothing")
            return [iri for iri in iris if iri not in left_out]

        return Filter(choose, others.guesses, others.cost)

    def empty(self) -> Filter:
        """Choose what has nothing on or in it."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            return [
                iri
                for iri in iris
                if not any(find_related(self._facts, name, [iri], is_direct=True) for name in ("on", "inside"))
            ]

        return Filter(choose)

    def of_kind(self, group: Group) -> Filter:
        """Choose the things that are among others."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            if not group.noun.iris:
                raise GraphError(group.noun.absence)
            return set(group.iris) & set(iris)

        return Filter(choose, group.guesses, group.cost)

    def excluding(self, group: Group) -> Filter:
        """Choose the things that are not among others, some of which are."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            left_out = set(group.iris)
            if left_out.isdisjoint(iris):
                raise GraphError(f"not known: no {group.text} are among these things, so none can be left out")
            return [iri for iri in iris if iri not in left_out]

        return Filter(choose, group.guesses, group.cost)

    def movable(self, verb: str) -> Filter:
        """Choose what opens or moves; of a kind, also what has a part that does: a cabinet is opened by its door."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            opened = find_openable(self._facts, self._nouns, verb).iris
            if len(iris) == len(self._facts.things):
                return opened
            return [i for i in iris if i in opened or not opened.isdisjoint(find_parts(self._facts, [i]))]

        return Filter(choose)

    def like(self, word: str) -> Filter:
        """Choose what has a colour or is made of a substance."""
        is_color = word in COLORS
        if not is_color and not is_material(word):
            raise ValueError(word)

        def choose(iris: Sequence[str]) -> Collection[str]:
            known = own_colors if is_color else material_words
            if iris and not any(known(self._facts, iri) for iri in iris):
                raise GraphError(f"not known: the graph does not state which of these things are {word}")
            has = has_color if is_color else has_material
            return [iri for iri in iris if has(self._facts, iri, word)]

        return Filter(choose)

    def beyond(self, measure: Measure, sign: int, amount: float, *, or_equal: bool = False) -> Filter:
        """Choose what has more of a measure than an amount, or less if the sign is -1."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            values = self.measured(iris, measure)
            return [
                iri
                for iri, value in values.items()
                if sign * value > sign * amount or (or_equal and not self._bodies.differ(value, amount))
            ]

        return Filter(choose)

    def compared(self, measure: Measure, sign: int, others: Group) -> Filter:
        """Choose what has more of a measure than each of others, or less."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            if len(iris) == 1 and iris[0] in others.iris:
                raise UnknownWordError(f"{others.text!r} include what they are compared with")
            limits = [sign * value for value in self.measured(others.existing(), measure).values()]
            values, rivals = self.measured(iris, measure), set(others.iris)
            own = {iri: sign * value for iri, value in values.items() if iri not in rivals}
            return [i for i, value in own.items() if value > max(limits) and self._bodies.differ(value, max(limits))]

        return Filter(choose, others.guesses, others.cost)

    def equal(self, measure: Measure, others: Group) -> Filter:
        """Choose what has as much of a measure as others."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            wanted = list(self.measured(others.existing(), measure).values())
            values = self.measured(iris, measure)
            chosen = [i for i, value in values.items() if not all(self._bodies.differ(value, one) for one in wanted)]
            return [iri for iri in chosen if iri not in others.iris]

        return Filter(choose, others.guesses, others.cost)

    def most(self, measure: Measure, sign: int, count: int = 1) -> Filter:
        """Choose what has the most of a measure, or the least; with what is equal to the last of a number of things."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            values = self.measured(iris, measure) if iris else {}
            if measure is ELEVATION and len(set(values.values())) == 1:
                # Of what stands on one floor, the highest is the tallest.
                values = self.measured(iris, TOP)
            order = sorted(values, key=lambda iri: -sign * values[iri])
            if not order:
                return []
            last = values[order[min(count, len(order)) - 1]]
            return [iri for iri in order if sign * values[iri] >= sign * last]

        return Filter(choose, is_relative=True)

    def nearest(self, others: Group, sign: int) -> Filter:
        """Choose what has the least gap to others, or the largest if the sign is -1."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            others.existing()
            anchors = [iri for iri in others.iris if iri not in iris] or [*others.iris]
            rivals = self._rivals(iris, anchors)
            gaps = self._bodies.gaps(rivals, anchors)
            if not gaps:
                raise GraphError(f"not known: the graph has no boxes for {others.text}")
            return self._facts.sorted(nearest_of(gaps, sign))

        return Filter(choose, others.guesses, others.cost, is_relative=True)

    def _rivals(self, iris: Sequence[str], anchors: Sequence[str]) -> Sequence[str]:
        """Return what may be nearest to others: of all things, not what holds them, nor their parts or the room."""
        if len(iris) < len(self._facts.things):
            return iris
        left_out = {*anchors, *self._nouns.shells(), *find_parts(self._facts, anchors)}
        left_out |= {one for iri in anchors for one in self._holders(iri)}
        return [iri for iri in iris if iri not in left_out]

    def within(self, others: Group, amount: float, *, is_beyond: bool = False) -> Filter:
        """Choose what is up to a distance from others, or beyond it."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            gaps = self._bodies.gaps(iris, others.existing())
            return [iri for iri, gap in gaps.items() if (gap > amount) is is_beyond]

        return Filter(choose, others.guesses, others.cost)

    def same_place(self, relation: str, places: Group, others: Group) -> Filter:
        """Choose what is on or in the same one of some places as others."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            held = set(others.existing())
            around = [find_related(self._facts, relation, [place], is_direct=False) for place in places.existing()]
            together = {iri for one in around if one & held for iri in one}
            if not together:
                raise GraphError(f"not known: no {places.text} has {others.text} {relation} it")
            return (together - held) & set(iris)

        return Filter(choose, (*places.guesses, *others.guesses), places.cost + others.cost)

    def together(self, relation: str, places: Group) -> Filter:
        """Choose all things if one place has them all; else none: on the same wall."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            names = ("on", "attached") if relation == "on" else (relation,)
            held = [
                {one for name in names for one in self._in_relation(name, [place], iris)} for place in places.existing()
            ]
            if not any(held):
                raise GraphError(f"not known: no {places.text} is known to have any of these things")
            return iris if any(found.issuperset(iris) for found in held) else []

        return Filter(choose, places.guesses, places.cost)

    def counted(self, text: str, count: int) -> Filter:
        """Choose all things, which are as many as a question takes for granted: the two cups."""

        def choose(iris: Sequence[str]) -> Collection[str]:
            if len(iris) != count:
                raise GraphError(f"not known which {count} {text} are meant, of {len(iris)}")
            return iris

        return Filter(choose)

    def part_of(self, wholes: Group) -> Filter:
        """Choose the parts of things."""
        return Filter(lambda iris: find_parts(self._facts, wholes.existing()) & set(iris), wholes.guesses, wholes.cost)

    def measured(self, iris: Sequence[str], measure: Measure) -> dict[str, float]:
        """Return the measure of each thing.

        Raises:
            GraphError: none of them has it, or only some have a mass.
        """
        values = self._bodies.values(iris, measure)
        if iris and not values:
            missing = "mass" if measure is MASS else "box"
            raise GraphError(f"not known: the graph has no {missing} for these things")
        return values


def negated(one: Filter) -> Filter:
    """Choose that to which another filter does not apply."""

    def choose(iris: Sequence[str]) -> Collection[str]:
        left_out = set(one.choose(iris))
        return [iri for iri in iris if iri not in left_out]

    return Filter(choose, one.guesses, one.cost, one.is_relative)


def both(one: Filter, other: Filter, *, is_or: bool = False) -> Filter:
    """Choose that to which two filters apply, or one of them."""

    def choose(iris: Sequence[str]) -> Collection[str]:
        found, also = set(one.choose(iris)), set(other.choose(iris))
        return found | also if is_or else found & also

    guesses, cost = (*one.guesses, *other.guesses), one.cost + other.cost
    return Filter(choose, guesses, cost, one.is_relative or other.is_relative)


def then(one: Filter, other: Filter) -> Filter:
    """Choose by a filter, and from what it leaves by another."""

    def choose(iris: Sequence[str]) -> Collection[str]:
        found = set(one.choose(iris))
        return other.choose([iri for iri in iris if iri in found])

    guesses, cost = (*one.guesses, *other.guesses), one.cost + other.cost
    return Filter(choose, guesses, cost, one.is_relative or other.is_relative)


EVERYTHING = Filter(lambda iris: iris)
"""Chooses all things."""
