"""Answers about what things are like: a colour, a material, a kind, and what has the same as another."""

from collections.abc import Mapping, Sequence

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few, name_things, the_thing, yes_or_no
from usd2kg.errors import GraphError
from usd2kg.query.lookup import Things, UnknownWordError
from usd2kg.query.lookup.body_measures import MEASURES
from usd2kg.query.lookup.colors import COLORS, has_color, has_material, is_material, material_words, own_colors
from usd2kg.query.lookup.modifiers import restricts

__all__ = ["LikenessAnswers"]

_COLOR_NOUNS = frozenset(["colour", "color"])


class LikenessAnswers(Answers):
    """Answers about the looks and kinds of things in one graph."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "all-same": self._all_same,
            "is-kind": self._is_kind,
            "is-like": self._is_like,
            "same-as": self._same_as,
        }

    def _is_like(self, thing: str, adjective: str) -> InterpretedAnswer:
        """Return whether things have a colour, a material or a state that an adjective names."""
        things, word = self._nouns.existing(thing), adjective.lower()
        if word in COLORS:
            known = {iri: ", ".join(own_colors(self._facts, iri)) for iri in things.iris}
            chosen = [iri for iri in things.iris if has_color(self._facts, iri, word)]
        elif is_material(word):
            known = {iri: ", ".join(material_words(self._facts, iri)) for iri in things.iris}
            chosen = [iri for iri in things.iris if has_material(self._facts, iri, word)]
        elif restricts(word):
            found = self._nouns.find(f"{word} {thing}")
            return self._verdict(things, word, [iri for iri in things.iris if iri in found.iris])
        else:
            raise UnknownWordError(f"{adjective!r} is not understood as a property")
        if not all(known.values()):
            raise GraphError(f"not known: the graph does not state whether {things.text} is {word}{things.suffix}")
        return self._verdict(things, word, chosen)

    def _verdict(self, things: Things, word: str, chosen: Sequence[str]) -> InterpretedAnswer:
        count, is_so = len(things.iris), len(chosen) == len(things.iris)
        said = f"{len(chosen)} of {count} {things.text} are {word}"
        if count == 1:
            named = the_thing(self._facts.kind(things.iris[0]), self._facts.label(things.iris[0]))
            said = f"{named} is {'' if is_so else 'not '}{word}"
        return InterpretedAnswer(
            f"whether {things.text} is {word}",
            self._facts.table(things.iris),
            is_so,
            sentence=yes_or_no(is_so, f"{said}{things.suffix}."),
        )

    def _is_kind(self, thing: str, kind: str) -> InterpretedAnswer:
        """Return whether things are known to be of a kind."""
        things, members = self._nouns.existing(thing), set(self._nouns.find(kind, may_shorten=False).iris)
        is_so = all(iri in members for iri in things.iris)
        parts = [f"{self._facts.label(iri)} is known as {self._facts.kind(iri)}" for iri in things.iris]
        return InterpretedAnswer(
            f"whether {things.text} is {kind}",
            self._facts.table(things.iris),
            is_so,
            sentence=yes_or_no(is_so, f"{join_few(parts)}{things.suffix}."),
        )

    def _values(self, iris: Sequence[str], attribute: str) -> dict[str, str]:
        """Return each thing's value of an attribute, in words; things without one are left out."""
        word = attribute.lower()
        if word in _COLOR_NOUNS:
            found = {iri: next(iter(own_colors(self._facts, iri)), "") for iri in iris}
        elif word == "material":
            found = {iri: ", ".join(material_words(self._facts, iri)) for iri in iris}
        elif word in MEASURES:
            measure = MEASURES[word]
            found = {iri: self._text(value, measure.unit) for iri, value in self._bodies.values(iris, measure).items()}
        else:
            raise UnknownWordError(f"{attribute!r} is not understood as an attribute")
        return {iri: value for iri, value in found.items() if value}

    def _same_as(self, kind: str, attribute: str, thing: str) -> InterpretedAnswer:
        """Return the things of a kind that have the same colour, material or measure as another."""
        things, others = self._nouns.existing(kind), self._nouns.existing(thing)
        wanted = set(self._values(others.iris, attribute).values())
        if not wanted:
            raise GraphError(f"not known: the graph has no {attribute} for {others.text}{others.suffix}")
        found = self._values([iri for iri in things.iris if iri not in others.iris], attribute)
        chosen = [iri for iri, value in found.items() if value in wanted]
        named, verb = name_things(self._facts, chosen) or f"no {things.text}", "have" if len(chosen) > 1 else "has"
        said = f"{named} {verb} the {attribute} of {others.text}, {' or '.join(sorted(wanted))}"
        return InterpretedAnswer(
            f"{things.text} with the {attribute} of {others.text}",
            self._facts.table(chosen),
            sentence=begin_sentence(f"{said}{things.suffix}{others.suffix}."),
        )

    def _all_same(self, kind: str, attribute: str) -> InterpretedAnswer:
        """Return whether all things of a kind have the same colour, material or measure."""
        things = self._nouns.existing(kind)
        values = self._values(things.iris, attribute)
        if len(values) < len(things.iris):
            missing = len(things.iris) - len(values)
            raise GraphError(
                f"not known: the graph has no {attribute} for {missing} of {len(things.iris)} {things.text}"
            )
        different = sorted(set(values.values()))
        is_so = len(different) == 1
        if (measure := MEASURES.get(attribute.lower())) is not None:
            amounts = self._bodies.values(things.iris, measure).values()
            is_so = not self._bodies.differ(min(amounts), max(amounts))
        return InterpretedAnswer(
            f"whether all {things.text} have the same {attribute}",
            self._facts.table(things.iris),
            is_so,
            sentence=yes_or_no(is_so, f"the {attribute} of {things.text} is {join_few(different)}{things.suffix}."),
        )
