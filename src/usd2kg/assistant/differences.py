"""Answers about how much more of a measure a thing has than another, or than an amount, and whether it has the most."""

from collections.abc import Mapping

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few, yes_or_no
from usd2kg.errors import GraphError
from usd2kg.query.lookup import Things
from usd2kg.query.lookup.amounts import read_amount
from usd2kg.query.lookup.body_measures import (
    COMPARED,
    ELEVATION,
    MASS,
    MEASURES,
    SIZE,
    SUPERLATIVES,
    Measure,
)

__all__ = ["DifferenceAnswers"]


class DifferenceAnswers(Answers):
    """Answers about differences of measures in one graph."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {
            "difference": self._difference,
            "is-limit": self._is_limit,
            "is-most": self._is_most,
            "compare-measures": self._compare_measures,
        }

    def _difference(self, thing: str, adjective: str, other: str) -> InterpretedAnswer:
        """Return by how much two things differ in a measure."""
        word = adjective.lower()
        measure = COMPARED[word][0] if word in COMPARED else MEASURES[word]
        if measure is SIZE:
            raise GraphError(f"{adjective!r} is no single measure; expected one such as taller, wider or heavier")
        (first, one), (second, two) = (self._single(text, measure) for text in (thing, other))
        sign = COMPARED[word][1] if word in COMPARED else 1
        difference = one - two
        both = f"{self._text(one, measure.unit)} against {self._text(two, measure.unit)}"
        by = self._text(abs(difference), measure.unit)
        if word in COMPARED and sign * difference < 0:
            said = f"{first.text} is not {word} than {second.text}, but {by} less so: {both}"
        else:
            said = f"{first.text} and {second.text} differ by {by} in how {measure.name} they are: {both}"
        return InterpretedAnswer(
            f"difference between {first.text} and {second.text} in how {measure.name} they are",
            self._facts.table((*first.iris, *second.iris)),
            number=round(sign * difference if word in COMPARED else abs(difference), 4),
            sentence=begin_sentence(f"{said}{first.suffix}{second.suffix}."),
        )

    def _single(self, text: str, measure: Measure) -> tuple[Things, float]:
        """Return what a noun phrase means and its measure, which all things that are meant share.

        Raises:
            GraphError: the measure is unknown, or differs among several things.
        """
        things = self._nouns.existing(text)
        values = self._bodies.values(things.iris, measure)
        if not values:
            raise self._bodies.unmeasured(things, measure)
        low, high = min(values.values()), max(values.values())
        if self._bodies.differ(low, high):
            labels = join_few([*map(self._facts.label, things.iris)])
            raise GraphError(
                f"not known: {text!r} are things of several measures; expected the name of one of {labels}"
            )
        return things, low

    def _is_limit(self, thing: str, adjective: str, amount: str, placed: str = "") -> InterpretedAnswer:
        """Return whether things have more or less of a measure than an amount; of height, where they are mounted."""
        things = self._nouns.existing(thing)
        measure, sign = COMPARED[adjective.lower()]
        measure = ELEVATION if placed else measure
        value, unit = read_amount(amount)
        if measure is SIZE or unit != measure.unit:
            raise GraphError(f"{amount!r} does not measure what is {adjective}; expected a number with {measure.unit}")
        values = self._bodies.values(things.iris, measure)
        if len(values) < len(things.iris):
            raise self._bodies.unmeasured(things, measure)
        is_so = all(sign * own > sign * value for own in values.values())
        verb = "weighs" if measure is MASS else "measures"
        parts = [f"{self._facts.label(iri)} {verb} {self._text(own, measure.unit)}" for iri, own in values.items()]
        return InterpretedAnswer(
            f"whether {things.text} is {adjective} than {amount}",
            self._facts.table(values),
            is_so,
            sentence=f"{'Yes' if is_so else 'No'}: {join_few(parts)}{things.suffix}.",
        )

    def _is_most(self, thing: str, adjective: str, kind: str = "things") -> InterpretedAnswer:
        """Return whether a thing has the most or the least of a measure among things of a kind."""
        things, among = self._nouns.existing(thing), self._nouns.existing(kind)
        measure, sign = SUPERLATIVES[adjective.lower()]
        values = self._bodies.values({*among.iris, *things.iris}, measure)
        if not all(iri in values for iri in things.iris):
            raise self._bodies.unmeasured(things, measure)
        best = max(sign * value for value in values.values())
        first = min((iri for iri in values if sign * values[iri] == best), key=self._facts.path)
        is_so = any(sign * values[iri] == best for iri in things.iris)
        amount = "" if measure is SIZE else f", {self._text(values[first], measure.unit)}"
        known = (
            f" of the {len(values)} whose mass is known" if measure is MASS and len(values) < len(among.iris) else ""
        )
        said = f"the {adjective.lower()} {among.text}{known} is {self._facts.label(first)}{amount}"
        return InterpretedAnswer(
            f"whether {things.text} is the {adjective} of {among.text}",
            self._facts.table([first]),
            is_so,
            sentence=yes_or_no(is_so, f"{said}{things.suffix}{among.suffix}."),
        )

    def _compare_measures(self, thing: str, adjective: str, other: str, measure: str) -> InterpretedAnswer:
        """Return whether one measure of a thing is more than another measure of another: longer than it is wide."""
        left, sign = COMPARED[adjective.lower()]
        right = MEASURES[measure.lower()]
        if SIZE in (left, right) or left.unit != right.unit:
            raise GraphError(f"{adjective!r} and {measure!r} are not lengths that can be compared")
        (first, one), (second, two) = self._single(thing, left), self._single(other, right)
        is_so = sign * one > sign * two
        said = (
            f"{first.text} is {self._text(one, left.unit)} {left.name}, "
            f"{second.text} is {self._text(two, right.unit)} {right.name}"
        )
        return InterpretedAnswer(
            f"whether {first.text} is {adjective} than {second.text} is {measure}",
            self._facts.table((*first.iris, *second.iris)),
            is_so,
            sentence=yes_or_no(is_so, f"{said}{first.suffix}{second.suffix}."),
        )
