"""Answers about a measure of several things: in order, in total and on average."""

from collections.abc import Mapping

from usd2kg.assistant.answers import Answers, Handler
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.sentences import begin_sentence, join_few
from usd2kg.errors import GraphError
from usd2kg.query.lookup import Things
from usd2kg.query.lookup.body_measures import MASS, MEASURES, SIZE, SUPERLATIVES, Measure

__all__ = ["SeriesAnswers"]

_MEANS = frozenset(["average", "mean"])


class SeriesAnswers(Answers):
    """Answers about a measure of several things of one graph."""

    def _handlers(self) -> Mapping[str, Handler]:
        return {"sorted": self._sorted, "total": self._total}

    def _sorted(self, kind: str, measure: str = "size", first: str = "") -> InterpretedAnswer:
        """Return the things of a kind by a measure, the most first unless the question says otherwise."""
        order, sign = SUPERLATIVES[first.lower()] if first else (MEASURES[measure.lower()], 1)
        things, values = self._measured(kind, order)
        ranked = sorted(values, key=lambda iri: (-sign * values[iri], self._facts.path(iri)))
        parts = [
            self._facts.label(iri)
            if order is SIZE
            else f"{self._facts.label(iri)} {self._text(values[iri], order.unit)}"
            for iri in ranked
        ]
        column = {"mass_kg" if order is MASS else f"{order.name}_m": values}
        return InterpretedAnswer(
            f"{things.text} by how {order.name} they are",
            self._facts.table(ranked, **column),
            sentence=f"In order: {join_few(parts)}{things.suffix}.",
        )

    def _total(self, how: str, measure: str, thing: str) -> InterpretedAnswer:
        """Return the sum or the mean of a measure of things."""
        quantity = MEASURES[measure.lower()]
        if quantity is SIZE:
            raise GraphError(f"{measure!r} cannot be added up; expected a measure such as weight, area or length")
        things, values = self._measured(thing, quantity)
        is_mean = how.lower() in _MEANS
        amount = sum(values.values()) / (len(values) if is_mean else 1)
        said = f"the {how} {measure} of {len(values)} {things.text} is {self._text(amount, quantity.unit)}"
        return InterpretedAnswer(
            f"{how} {measure} of {things.text}",
            self._facts.table(values),
            number=round(amount, 4),
            sentence=begin_sentence(f"{said}{things.suffix}."),
        )

    def _measured(self, text: str, measure: Measure) -> tuple[Things, dict[str, float]]:
        """Return things and the measure of each.

        Raises:
            GraphError: one of them lacks it.
        """
        things = self._nouns.existing(text)
        values = self._bodies.values(things.iris, measure)
        if len(values) < len(things.iris):
            missing, what = len(things.iris) - len(values), "mass" if measure is MASS else "box"
            raise GraphError(f"not known: {missing} of {len(things.iris)} {things.text} lack a {what}")
        return things, values
