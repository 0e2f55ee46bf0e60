"""ComposedAnswers: answers to the readings of a question that account for all of its words."""

from collections.abc import Callable

from usd2kg.assistant.composition.filters import EVERYTHING, Filters
from usd2kg.assistant.composition.groups import EACH, Group, Quantity
from usd2kg.assistant.composition.noun_phrases import KnownNouns
from usd2kg.assistant.composition.questions import Questions, Reading
from usd2kg.assistant.interpreted_answer import InterpretedAnswer, contradict
from usd2kg.assistant.relation_answers import RelationAnswers
from usd2kg.assistant.sentences import begin_sentence, count_phrase, join_few, yes_or_no
from usd2kg.assistant.thing_lists import ThingLists
from usd2kg.errors import GraphError
from usd2kg.query.lookup import Nouns, SceneFacts, UnknownWordError
from usd2kg.query.lookup.word_forms import singular

__all__ = ["ComposedAnswers"]

_Find = Callable[[str], Callable[..., InterpretedAnswer] | None]
_PARAMETERS = {
    "choose": ("thing", "other"),
    "color": ("thing",),
    "distance": ("thing", "other"),
    "material": ("thing",),
    "measure": ("thing",),
    "total": ("thing",),
    "where": ("thing",),
}
"""Question type of a handler → its parameters for noun phrases."""


class ComposedAnswers:
    """Answers questions by composition."""

    def __init__(self, facts: SceneFacts, nouns: Nouns, relations: RelationAnswers, find: _Find) -> None:
        """Wrap a graph.

        Args:
            facts: the graph.
            nouns: resolves noun phrases.
            relations: finds what is in a relation to things.
            find: returns the handler of a question type.
        """
        self._facts = facts
        self._nouns = nouns
        self._filters = Filters(facts, nouns, relations)
        self._things = ThingLists(facts, nouns)
        self._find = find
        self._known: KnownNouns = {}

    def answer(self, text: str) -> InterpretedAnswer | None:
        """Return the answer to a question by its nearest reading; None if no reading accounts for all words.

        Raises:
            GraphError: the graph does not know the answer, or two readings that are as near have different answers.
        """
        readings = Questions(text, self._facts, self._nouns, self._filters, self._known).read()
        # Words that were tried as nouns, and are none in any reading, are no guesses.
        self._nouns.notes.clear()
        self._nouns.guesses.clear()
        answers: list[InterpretedAnswer] = []
        problem = ""
        for cost in sorted({reading.cost for reading in readings}):
            for reading in readings:
                if reading.cost != cost:
                    continue
                try:
                    answers.append(self._answer(reading))
                except GraphError as error:
                    # The error itself would be a reference cycle, which keeps the graph.
                    problem = problem or str(error)
            if answers:
                break
        if not answers:
            if problem:
                raise GraphError(problem)
            return None
        first = answers[0]
        if other := next((one for one in answers if contradict(one, first)), None):
            raise UnknownWordError(
                f"{text!r} may mean two things, with different answers: {first.sentence} Or: {other.sentence} "
                "Expected a question with one meaning"
            )
        return first

    def _answer(self, reading: Reading) -> InterpretedAnswer:
        known = len(self._nouns.notes)
        answer = self._by_type(reading)
        answer = answer.with_notes((*reading.guesses, *self._nouns.notes[known:]))
        if not (answer.answer.rows or answer.number or answer.verdict) and reading.guesses:
            raise UnknownWordError(f"not known: {reading.guesses[0]}, and nothing was found")
        return answer

    def _by_type(self, reading: Reading) -> InterpretedAnswer:
        if reading.type in _PARAMETERS:
            return self._by_handler(reading)
        first = reading.groups[0]
        match reading.type:
            case "claim":
                return self._claim(reading)
            case "more":
                return self._more(reading)
        by_group = {"count": self._count, "exists": self._exists, "list": self._list, "places": self._places}
        return by_group[reading.type](first)

    def _by_handler(self, reading: Reading) -> InterpretedAnswer:
        names = _PARAMETERS[reading.type]
        given = {name: self._nouns.define(group.things) for name, group in zip(names, reading.groups, strict=True)}
        handler = self._find(reading.type)
        if handler is None:
            raise KeyError(reading.type)
        return handler(**given, **dict(reading.given))

    def _list(self, group: Group) -> InterpretedAnswer:
        self._check_exists(group)
        return self._things.answer(group.things, group.said)

    def _check_exists(self, group: Group) -> None:
        """Check that the scene has things of a noun, of which others may be asked.

        Raises:
            GraphError: it has none.
        """
        if not group.noun.iris:
            raise GraphError(group.noun.absence)

    def _places(self, group: Group) -> InterpretedAnswer:
        found = self._things.answer(group.things)
        paths = tuple(map(self._facts.path, group.iris))
        if not paths:
            raise GraphError(f"not known: {found.sentence}")
        return InterpretedAnswer(found.understood, found.answer, sentence=found.sentence, places=paths)

    def _count(self, group: Group) -> InterpretedAnswer:
        self._check(group)
        self._check_exists(group)
        things = group.things
        count = len(things.iris)
        verb = "is" if count == 1 else "are"
        sentence = (
            f"There {verb} {count_phrase(count, things.text)}." if count else f"{begin_sentence(things.absence)}."
        )
        return InterpretedAnswer(
            f"number of {things.text}", self._things.located(things.iris), number=count, sentence=sentence
        )

    def _check(self, group: Group) -> None:
        self._things.check_kind(group.noun)

    def _exists(self, group: Group) -> InterpretedAnswer:
        self._check(group)
        if group.noun.note:
            raise UnknownWordError(f"not known: {group.noun.note}, which may be something else")
        count = len(group.iris)
        quantity = group.quantity if group.quantity is not None and not group.quantity.is_each else Quantity(1)
        found = self._things.answer(group.things, group.said)
        yes = quantity.holds(count)
        return InterpretedAnswer(
            f"whether there is {group.text}", found.answer, yes, sentence=yes_or_no(yes, found.sentence)
        )

    def _claim(self, reading: Reading) -> InterpretedAnswer:
        (group,), predicate = reading.groups, reading.predicate or EVERYTHING
        if group.is_general and group.quantity is not None and group.quantity.high == 0:
            raise UnknownWordError("nothing")
        self._check(group)
        subjects = group.iris
        quantity = group.quantity
        is_certain = quantity is None
        if quantity is None:
            quantity = EACH
        if not subjects and quantity.is_each:
            raise GraphError(group.things.absence)
        chosen = set(predicate.choose(subjects))
        kept = [iri for iri in subjects if iri in chosen]
        if is_certain and not group.is_plural and 0 < len(kept) < len(subjects):
            raise GraphError(
                f"not known which {group.text} is meant: it is so of {len(kept)} of {len(subjects)}; "
                f"expected the name of one: {join_few([self._facts.label(iri) for iri in subjects])}"
            )
        yes = quantity.holds(len(kept), len(subjects))
        named = join_few([self._facts.label(iri) for iri in kept or subjects])
        if len(subjects) == 1:
            said = f"{named} {'is' if kept else 'is not'}"
        else:
            said = f"{len(kept)} of {count_phrase(len(subjects), singular(group.text))} ({named})"
        sentence = f"{'Yes' if yes else 'No'}: {said if subjects else group.things.absence}."
        return InterpretedAnswer(f"whether {group.text} are so", self._facts.table(kept), yes, sentence=sentence)

    def _more(self, reading: Reading) -> InterpretedAnswer:
        first, second = reading.groups
        one, two = len(first.iris), len(second.iris)
        word = dict(reading.given)["adjective"]
        yes = {"more": one > two, "fewer": one < two, "less": one < two}.get(word, one == two)
        said = f"there are {count_phrase(one, first.text)} and {count_phrase(two, second.text)}."
        return InterpretedAnswer(
            f"whether there are {word} {first.text} as {second.text}",
            self._facts.table((*first.iris, *second.iris)),
            yes,
            sentence=yes_or_no(yes, said),
        )
