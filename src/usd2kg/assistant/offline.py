"""ask_offline: answer a question in people's words, without a language model."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import NamedTuple

from usd2kg.assistant.antecedents import with_antecedent
from usd2kg.assistant.comparisons import ComparisonAnswers
from usd2kg.assistant.composition import ComposedAnswers
from usd2kg.assistant.coverage import (
    check_left,
    check_nothing,
    check_requests,
    is_partial,
    is_topic,
    leaves_out,
    says_less,
    tells_more,
    with_notes,
)
from usd2kg.assistant.describe import description_answer
from usd2kg.assistant.differences import DifferenceAnswers
from usd2kg.assistant.distances import DistanceAnswers
from usd2kg.assistant.foreign_questions import in_english
from usd2kg.assistant.intents import parse_intent
from usd2kg.assistant.interpreted_answer import InterpretedAnswer, contradict
from usd2kg.assistant.likeness import LikenessAnswers
from usd2kg.assistant.measures import MeasureAnswers
from usd2kg.assistant.misspellings import respelled
from usd2kg.assistant.openings import OpeningAnswers
from usd2kg.assistant.paraphrases import paraphrases
from usd2kg.assistant.phrases import Phrase, match_phrases, normalize, split_clauses
from usd2kg.assistant.relation_answers import RelationAnswers
from usd2kg.assistant.series import SeriesAnswers
from usd2kg.assistant.thing_answers import ThingAnswers
from usd2kg.assistant.units import Units
from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_map, word_set
from usd2kg.query import GraphStore
from usd2kg.query.answer import join_answers
from usd2kg.query.lookup import Nouns, UnknownWordError
from usd2kg.query.lookup.amounts import UNIT_SYMBOLS
from usd2kg.query.lookup.body_measures import BodyMeasures
from usd2kg.query.questions import list_questions
from usd2kg.query.unicode_text import check_text

__all__ = ["ask_offline"]

_Reader = Callable[[Phrase], InterpretedAnswer]


class _Attempt(NamedTuple):
    """What came of reading a question in one way."""

    answer: InterpretedAnswer | None = None
    question: str = ""
    """Id of the question type."""
    problem: str = ""
    is_known: bool = False
    """Whether the question was understood, and the graph does not know the answer."""


_COMPOSED = word_set("assistant", "composed_types")
"""Question types that composition reads in any words: what it does not read of them, a pattern may have misread."""

_ROOM_FOR = "fits"
"""Question type that asks what is possible (`can I put it there?`), where composition reads what is."""
_LISTS = frozenset(["all", "is-there", "noun"])
"""Question types whose sentence has less of the question than that of the composed answer."""


def ask_offline(graph: GraphStore, text: str, since: Path | None = None) -> InterpretedAnswer:
    """Return the answer to a question in English, or in German, French, Spanish and Italian by its words.

    A word that is not understood is an error, never the answer "no".

    Args:
        graph: the graph.
        text: the question.
        since: an older version of the scene, a graph or a stage, for questions about changes.

    Raises:
        GraphError: the question or one of its words is not understood.
    """
    check_text(text, "question")
    units = Units(text)
    asked = units.question
    found = [*match_phrases(asked), *filter(None, [parse_intent(asked)])]
    try:
        answer = _Answerer(graph, not found or found[0].is_english, units, since).answer(asked)
    except GraphError:
        if (other := in_english(asked) or respelled(asked, Nouns(graph.facts))) is None:
            raise
        answer = _reworded_answer(_Answerer(graph, True, units, since), other)
    else:
        if is_partial(answer) and (other := in_english(asked)) is not None:
            # A pattern of another language leaves out where to count: ¿Cuántas tazas hay en la mesa?
            answer = _reworded_answer(_Answerer(graph, True, units, since), other)
    units.check(answer.sentence)
    return answer


def _reworded_answer(answerer: "_Answerer", text: str) -> InterpretedAnswer:
    """Return the answer to a question that was translated word by word, or whose spelling was corrected.

    Raises:
        GraphError: the words are not understood, or mean nothing in the scene: others may be meant.
    """
    try:
        found = answerer.answer(text)
    except GraphError as error:
        raise GraphError(f"read as “{text}”: {error}") from error
    if found.verdict is None and not (found.answer.rows or found.number):
        raise GraphError(f"read as “{text}”: {found.sentence}")
    return found.with_notes([f"read as “{text}”"])


class _Answerer:
    """Answers questions about one graph."""

    def __init__(self, graph: GraphStore, is_english: bool, units: Units, since: Path | None) -> None:
        self._graph = graph
        self._since = since
        self._facts = graph.facts
        self._is_english = is_english
        self._nouns = Nouns(self._facts, is_english=is_english)
        self._bodies = BodyMeasures(self._facts)
        self._measures = MeasureAnswers(self._facts, self._nouns, units)
        self._distances = DistanceAnswers(self._facts, self._nouns, units)
        self._comparisons = ComparisonAnswers(self._facts, self._nouns, units)
        self._differences = DifferenceAnswers(self._facts, self._nouns, units)
        self._likeness = LikenessAnswers(self._facts, self._nouns, units)
        self._relations = RelationAnswers(graph.facts, self._nouns, units)
        self._series = SeriesAnswers(graph.facts, self._nouns, units)
        self._openings = OpeningAnswers(graph, self._nouns, units)
        self._lists = ThingAnswers(graph.facts, self._nouns, units)

    @property
    def _handlers(self) -> Mapping[str, Callable[..., InterpretedAnswer]]:
        # An attribute would be a reference cycle, which keeps the graph until the next full garbage collection.
        return {
            "about": self._about,
            "changed": self._changed,
            "parts": self._parts,
        }

    def answer(self, text: str) -> InterpretedAnswer:
        """Return the answer to a question, or to its last clause with what its pronoun means.

        Raises:
            GraphError: the question is not understood, or may mean two things with different answers.
        """
        clause = with_antecedent(text, self._is_noun_here)
        try:
            found = self._answer_whole(text)
        except GraphError:
            if clause is None:
                raise
            return self._answer_whole(clause)
        if clause is None or not says_less(found):
            return found
        try:
            return self._answer_whole(clause)
        except GraphError:
            return found

    def _answer_whole(self, text: str) -> InterpretedAnswer:
        """Return the answer by composition and by patterns, which must not contradict each other."""
        composed = self._first(text, self._composed_readers(text)) if self._is_english else _Attempt()
        matched = self._first(text, self._readers(text))
        if matched.answer is None:
            if composed.answer is not None:
                return composed.answer
            raise GraphError(matched.problem if matched.is_known else composed.problem or self._advice(text, matched))
        if composed.answer is None:
            if self._is_english and matched.question in _COMPOSED:
                raise GraphError(composed.problem or self._advice(text, matched))
            return matched.answer
        if matched.question == _ROOM_FOR:
            return matched.answer
        if not contradict(composed.answer, matched.answer):
            return composed.answer if matched.question in _LISTS else matched.answer
        # Composition knows more of the words that restrict a noun in a list.
        is_list = matched.question in _LISTS and not says_less(composed.answer)
        if is_list or tells_more(composed.answer, matched.answer):
            return composed.answer
        raise UnknownWordError(
            f"{text!r} may mean two things, with different answers: {composed.answer.sentence} "
            f"Or: {matched.answer.sentence}"
        )

    def _first(self, text: str, readers: Iterable[tuple[_Reader, Phrase]]) -> _Attempt:
        """Return the answer of the first reading of a question that its words allow."""
        problem = ""
        for read, phrase in readers:
            self._nouns.notes.clear()
            self._nouns.guesses.clear()
            try:
                self._check_topics(text, phrase)
                found = read(phrase)
                check_nothing(found, phrase, self._nouns.guesses)
                return _Attempt(
                    with_notes(found, phrase, text, self._nouns.notes, is_english=self._is_english), phrase.question
                )
            except UnknownWordError as error:
                # A pattern may have taken other words for a part of the noun. The error itself would be a reference
                # cycle, which keeps the graph.
                problem = problem or str(error)
            except GraphError as error:
                return _Attempt(None, phrase.question, str(error), is_known=True)
        return _Attempt(None, "", problem)

    def _advice(self, text: str, attempt: _Attempt) -> str:
        if attempt.problem and match_phrases(text):
            return attempt.problem
        return (
            f"question {text!r} is not understood{f' ({attempt.problem})' if attempt.problem else ''}; expected a "
            "question like 'what is on the table?', 'where is the kettle?', 'how many cups are there?' or 'what must "
            "be moved to open the drawer?' (usd2kg query --list shows more); or let a language model write the query "
            "with --model"
        )

    def _composed_readers(self, text: str) -> Iterator[tuple[_Reader, Phrase]]:
        """Yield the wordings of a question, and of each of its clauses, for composition."""
        whole, clauses = normalize(text), split_clauses(text)
        composer = ComposedAnswers(self._facts, self._nouns, self._relations, self.find)
        seen = set[str]()
        for at, asked in enumerate((whole, *reversed(clauses))):
            others = [clause for clause in clauses if at and clause != asked]
            for wording in (asked, *paraphrases(asked)):
                if wording not in seen:
                    seen.add(wording)
                    phrase = Phrase("composed", {"thing": wording}, left=tuple(others))
                    yield partial(self._answer_composed, composer), phrase

    def _answer_composed(self, composer: ComposedAnswers, phrase: Phrase) -> InterpretedAnswer:
        check_left(phrase)
        check_requests(phrase)
        found = composer.answer(phrase.given["thing"])
        if found is None:
            raise UnknownWordError("")
        return found

    def _check_topics(self, text: str, phrase: Phrase) -> None:
        """Check that no clause that a reading leaves out names things that the question is about.

        Raises:
            UnknownWordError: a clause does.
        """
        clauses = set(split_clauses(text))
        for part in phrase.left:
            if part in clauses and (is_topic(part) or self._means_things(part)):
                raise UnknownWordError(f"{part!r} beside the question is not understood")

    def _readers(self, text: str) -> list[tuple[_Reader, Phrase]]:
        """Return the readings of a question by pattern, cue or noun, first those that use all of it."""
        phrases = match_phrases(text)
        own: list[tuple[_Reader, Phrase]] = [(self._answer_phrase, phrase) for phrase in phrases]
        own += [(self._answer_intent, intent) for intent in [parse_intent(text)] if intent is not None]
        own += [] if own else [(self._answer_noun, Phrase("noun", {"thing": normalize(text)}))]
        for other in paraphrases(text):
            read: list[tuple[_Reader, Phrase]] = [(self._answer_phrase, phrase) for phrase in match_phrases(other)]
            read += [(self._answer_intent, intent) for intent in [parse_intent(other)] if intent is not None]
            own += read or [(self._answer_noun, Phrase("noun", {"thing": other}))]
        # A pattern of all words tells more than a cue.
        return sorted(own, key=lambda reading: (reading[0] != self._answer_phrase, leaves_out(reading[1])))

    def _is_noun_here(self, text: str) -> bool:
        """Return whether a text means objects of the scene, or names a kind that it lacks."""
        return self._means_things(text) or len(concepts_named(text)) == 1

    def _means_things(self, text: str) -> bool:
        try:
            return bool(self._nouns.find(text, may_shorten=False).iris)
        except GraphError:
            return False

    def _answer_intent(self, intent: Phrase) -> InterpretedAnswer:
        """Return the answer to a question that only its cue tells.

        Raises:
            GraphError: nothing is meant, so the words may have been misunderstood.
        """
        found = self._answer_phrase(intent)
        if not found.answer.rows and not found.number and intent.question != "is-there":
            raise GraphError(found.sentence or f"there is nothing in this scene: {found.understood}")
        return found

    def _answer_noun(self, noun: Phrase) -> InterpretedAnswer:
        return self._lists.list(self._nouns.find(noun.given["thing"], may_shorten=False))

    def find(self, question: str) -> Callable[..., InterpretedAnswer] | None:
        """Return the method that answers a question type; None for a ready question."""
        finders = (
            self._handlers.get,
            self._measures.find,
            self._distances.find,
            self._comparisons.find,
            self._differences.find,
            self._likeness.find,
            self._relations.find,
            self._openings.find,
            self._series.find,
            self._lists.find,
        )
        return next((found for find in finders if (found := find(question)) is not None), None)

    def _answer_phrase(self, phrase: Phrase) -> InterpretedAnswer:
        check_left(phrase)
        handler = self.find(phrase.question)
        if handler is None:
            return self._ready_question(phrase.question, phrase.given)
        # `class` is no name for a parameter.
        return handler(**{name.replace("class", "kind"): value for name, value in phrase.given.items()})

    def _parts(self, thing: str) -> InterpretedAnswer:
        answers = [self._graph.parts_of(self._facts.path(iri)) for iri in self._nouns.existing(thing).iris]
        return InterpretedAnswer(f"parts of {thing}", join_answers(answers))

    def _about(self, thing: str) -> InterpretedAnswer:
        answers = [description_answer(self._graph, self._facts.path(iri)) for iri in self._nouns.existing(thing).iris]
        return InterpretedAnswer(f"all about {thing}", join_answers(answers))

    def _changed(self, change: str = "changed", thing: str | None = None) -> InterpretedAnswer:
        # Loads OpenUSD, which no other question needs.
        from usd2kg.assistant.changes import NEEDS_OLDER_VERSION, answer_changes, changes_since  # noqa: PLC0415

        if self._since is None:
            raise GraphError(NEEDS_OLDER_VERSION)
        kind = word_map("assistant", "change_words").get(change.lower(), "changed")
        paths = None if thing is None else frozenset(map(self._facts.path, self._nouns.existing(thing).iris))
        return answer_changes(changes_since(self._since, self._graph), kind, paths)

    def _ready_question(self, question: str, given: Mapping[str, str]) -> InterpretedAnswer:
        """Return the answer to one of the questions that `usd2kg query --list` lists, for each object that is meant."""
        values = {name: _normalize(name, value) for name, value in given.items()}
        ready = next(q for q in list_questions() if q.id == question)
        understood = f"{question}: {ready.filled_text(values)}"
        if question == "nearest":
            return self._distances.nearest(understood, values)
        if "thing" not in values:
            return InterpretedAnswer(understood, self._graph.answer(question, values))
        paths = [self._facts.path(iri) for iri in self._nouns.existing(values["thing"]).iris]
        answers = [self._graph.answer(question, {**values, "thing": path}) for path in paths]
        found = join_answers(answers)
        return InterpretedAnswer(understood, found)


def _normalize(name: str, value: str) -> str:
    """Return a parameter value with unit symbols for unit names; a position without commas."""
    if name == "position":
        return " ".join(value.replace(",", " ").split())
    if name in {"distance", "mass"}:
        number = value.rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ ")
        unit = value[len(number) :].strip().lower()
        return f"{number} {UNIT_SYMBOLS.get(unit, unit)}".strip()
    return value
