"""ask_offline: answer a question in people's words, without a language model."""

import math
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from usd2kg.assistant.comparisons import ComparisonAnswers
from usd2kg.assistant.coverage import check_left, check_nothing, is_topic, leaves_out, with_notes
from usd2kg.assistant.describe import description_answer
from usd2kg.assistant.differences import DifferenceAnswers
from usd2kg.assistant.distances import DistanceAnswers
from usd2kg.assistant.intents import parse_intent
from usd2kg.assistant.interpreted_answer import InterpretedAnswer
from usd2kg.assistant.likeness import LikenessAnswers
from usd2kg.assistant.measures import MeasureAnswers
from usd2kg.assistant.openings import OpeningAnswers
from usd2kg.assistant.paraphrases import paraphrases
from usd2kg.assistant.phrases import Phrase, match_phrases, normalize, split_clauses
from usd2kg.assistant.relation_answers import PREPOSITIONS, RelationAnswers
from usd2kg.assistant.sentences import (
    begin_sentence,
    count_phrase,
    join_few,
    plural,
    split_number,
    the_thing,
    yes_or_no,
)
from usd2kg.assistant.series import SeriesAnswers
from usd2kg.assistant.settings import SENTENCES
from usd2kg.assistant.thing_lists import ThingLists
from usd2kg.assistant.units import Units
from usd2kg.errors import GraphError
from usd2kg.grounding import concepts_named
from usd2kg.knowledge import word_map, word_set
from usd2kg.query import Answer, GraphStore
from usd2kg.query.answer import join_answers
from usd2kg.query.lookup import Nouns, Things, UnknownWordError
from usd2kg.query.lookup.amounts import UNIT_SYMBOLS
from usd2kg.query.lookup.body_measures import BodyMeasures
from usd2kg.query.lookup.prepositions import RELATION_OF
from usd2kg.query.lookup.related_things import find_parts, find_related
from usd2kg.query.lookup.word_forms import is_plural, singular, split_phrase
from usd2kg.query.questions import list_questions
from usd2kg.query.unicode_text import check_text

__all__ = ["ask_offline"]

_Reader = Callable[[Phrase], InterpretedAnswer]
_PRONOUN = re.compile(r"\b(it|them|they)\b|(?<=there )one\b|(?<=find )one\b|(?<=see )one\b", re.IGNORECASE)
_LINKS = word_set("query", "connectives") | RELATION_OF.keys()
"""Words that lead to the modifier of a noun."""
_ANTECEDENT_WORDS = 20
"""Words before a pronoun among which its noun is looked for."""
_STOP_WORDS = word_set("assistant", "fillers") | word_set("query", "connectives")
"""Words that are in no noun."""


def ask_offline(graph: GraphStore, text: str, since: Path | None = None) -> InterpretedAnswer:
    """Return the answer to a question in English; frequent questions in German, French, Spanish and Italian too.

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
    answer = _Answerer(graph, not found or found[0].is_english, units, since).answer(asked)
    units.check(answer.sentence)
    return answer


class _Answerer:
    """Answers questions about one graph."""

    def __init__(self, graph: GraphStore, is_english: bool, units: Units, since: Path | None) -> None:
        self._graph = graph
        self._since = since
        self._facts = graph.facts
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
        self._things = ThingLists(self._facts, self._nouns)

    @property
    def _handlers(self) -> Mapping[str, Callable[..., InterpretedAnswer]]:
        # An attribute would be a reference cycle, which keeps the graph until the next full garbage collection.
        return {
            "about": self._about,
            "all": self._all,
            "changed": self._changed,
            "count": self._count,
            "has-parts": self._has_parts,
            "how-many": self._how_many,
            "is-there": self._is_there,
            "parts": self._parts,
            "parts-list": self._parts_list,
            "parts-of": self._parts_of,
            "stands-on": self._stands_on,
            "where": self._where,
            "which": self._which,
            "with-parts": self._with_parts,
        }

    def answer(self, text: str) -> InterpretedAnswer:
        """Return the answer to a question, by its pattern, else by its cue, or to a noun alone, such as `laptops?`."""
        phrases = match_phrases(text)
        readers = self._readers(text, phrases)
        problem = ""
        for read, phrase in readers:
            self._nouns.notes.clear()
            self._nouns.guesses.clear()
            try:
                self._check_topics(text, phrase)
                found = read(phrase)
                check_nothing(found, phrase, self._nouns.guesses)
                return with_notes(found, phrase, text, self._nouns.notes)
            except UnknownWordError as error:
                # A pattern may have taken other words for a part of the noun. The error itself would be a reference
                # cycle, which keeps the graph.
                problem = problem or str(error)
        if (clause := self._with_antecedent(text)) is not None:
            return self.answer(clause)
        if phrases:
            raise UnknownWordError(problem)
        raise GraphError(
            f"question {text!r} is not understood ({problem}); expected a question like 'what is on the table?', "
            "'where is the kettle?', 'how many cups are there?' or 'what must be moved to open the drawer?' "
            "(usd2kg query --list shows more); or let a language model write the query with --model"
        )

    def _check_topics(self, text: str, phrase: Phrase) -> None:
        """Check that no clause that a reading leaves out names things that the question is about.

        Raises:
            UnknownWordError: a clause does.
        """
        clauses = set(split_clauses(text))
        for part in phrase.left:
            if part in clauses and (is_topic(part) or self._means_things(part)):
                raise UnknownWordError(f"{part!r} beside the question is not understood")

    def _readers(self, text: str, phrases: Sequence[Phrase]) -> list[tuple[_Reader, Phrase]]:
        """Return the readings of a question, first those that use all of it; of other wordings if its own fail."""
        own: list[tuple[_Reader, Phrase]] = [(self._answer_phrase, phrase) for phrase in phrases]
        own += [(self._answer_intent, intent) for intent in [parse_intent(text)] if intent is not None]
        own += [] if own else [(self._answer_noun, Phrase("noun", {"thing": normalize(text)}))]
        for other in paraphrases(text):
            read: list[tuple[_Reader, Phrase]] = [(self._answer_phrase, phrase) for phrase in match_phrases(other)]
            read += [(self._answer_intent, intent) for intent in [parse_intent(other)] if intent is not None]
            own += read or [(self._answer_noun, Phrase("noun", {"thing": other}))]
        # A pattern of all words tells more than a cue.
        return sorted(own, key=lambda reading: (reading[0] != self._answer_phrase, leaves_out(reading[1])))

    def _with_antecedent(self, text: str) -> str | None:
        """Return the clause with a pronoun, and in its place a noun of the clauses before; None if there is none."""
        clauses = split_clauses(text)
        for at, clause in reversed([*enumerate(clauses)][1:]):
            if (pronoun := _PRONOUN.search(clause)) is None:
                continue
            words = " ".join(clauses[:at]).split()[-_ANTECEDENT_WORDS:]
            runs = (words[end - size : end] for size in range(4, 0, -1) for end in range(len(words), size - 1, -1))
            named = (" ".join(run) for run in runs if not _STOP_WORDS.intersection(word.lower() for word in run))
            many = pronoun[0].lower() in {"them", "they"}
            noun = next((name for name in named if is_plural(name) is many and self._is_noun_here(name)), None)
            if noun is not None:
                return f"{clause[: pronoun.start()]}the {noun}{clause[pronoun.end() :]}"
        return None

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
        return self._list(self._nouns.find(noun.given["thing"], may_shorten=False))

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
        )
        return next((found for find in finders if (found := find(question)) is not None), None)

    def _answer_phrase(self, phrase: Phrase) -> InterpretedAnswer:
        check_left(phrase)
        handler = self.find(phrase.question)
        if handler is None:
            return self._ready_question(phrase.question, phrase.given)
        # `class` is no name for a parameter.
        return handler(**{name.replace("class", "kind"): value for name, value in phrase.given.items()})

    # Lists and counts.

    def _all(self, kind: str = "things", **_: str) -> InterpretedAnswer:
        return self._list(self._nouns.find(kind))

    def _list(self, things: Things) -> InterpretedAnswer:
        is_modified = not _LINKS.isdisjoint(things.text.split())
        if not things.iris and not is_modified and not concepts_named(things.text):
            raise UnknownWordError(f"{things.text!r} is not a thing that the lexicon knows")
        return self._things.answer(things)

    def _how_many(self, kind: str) -> InterpretedAnswer:
        things = self._nouns.find(kind)
        self._things.check_kind(things)
        count = len(things.iris)
        verb = "is" if count == 1 else "are"
        *before, last = things.text.split() or ["thing"]
        named = " ".join([*before, singular(last)]) if count == 1 else plural(things.text)
        sentence = f"There {verb} {count} {named}{things.suffix}." if count else f"{begin_sentence(things.absence)}."
        return InterpretedAnswer(
            f"number of {things.text}", self._things.located(things.iris), number=count, sentence=sentence
        )

    def _count(self) -> InterpretedAnswer:
        facts = self._facts
        counts = facts.class_counts()
        rows = tuple(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
        table = Answer(("class", "count"), tuple((label, str(count)) for label, count in rows), rows, "")
        sentence = f"There are {len(facts.things)} objects of {len(counts)} classes."
        return InterpretedAnswer("number of objects of each class", table, number=len(facts.things), sentence=sentence)

    def _is_there(self, kind: str, count: str = "") -> InterpretedAnswer:
        exact, kind = split_number(f"{count} {kind}" if count else kind)
        things = self._nouns.find(kind, may_shorten=False)
        self._things.check_kind(things)
        answer = self._things.answer(things)
        yes = len(things.iris) == exact if count else len(things.iris) >= exact
        said = yes_or_no(yes, answer.sentence)
        return InterpretedAnswer(f"whether there is {things.text}", answer.answer, yes, sentence=said)

    # Places and parts.

    def _where(self, thing: str) -> InterpretedAnswer:
        facts, things = self._facts, self._nouns.find(thing)
        if not things.iris:
            return InterpretedAnswer(
                f"where: {things.text}", facts.table(()), sentence=f"{begin_sentence(things.absence)}."
            )
        parts, places = [], []
        for iri in things.iris:
            said: list[str] = []
            rooms = facts.anchors("room", iri)
            held = [
                (name, anchor)
                for name in ("on", "inside", "attached", "part")
                for anchor in facts.anchors(name, iri)
                if anchor not in rooms
            ]
            # The smallest thing that holds it says most about the place.
            held.sort(key=lambda found: self._volume(found[1]))
            held = held or [("room", anchor) for anchor in rooms]
            places += [anchor for _, anchor in held]
            named_once = dict(reversed(held))
            said += [
                f"{PREPOSITIONS.get(name, 'in')} {the_thing(facts.kind(anchor), facts.label(anchor))}"
                for name, anchor in held
                if named_once[name] == anchor
            ]
            body = facts.body(iri)
            if body.lower is not None and body.upper is not None:
                x, y, z = (body.lower + body.upper) / 2
                said.append(f"at ({x:.2f}, {y:.2f}, {z:.2f}) m")
            parts.append(f"{facts.label(iri)} is {', '.join(said) or 'somewhere, without a known place'}")
        rest = len(parts) - SENTENCES.max_named
        shown = "; ".join([*parts[: SENTENCES.max_named], *([f"and {rest} more"] if rest > 0 else [])])
        sentence = f"{shown}{things.suffix}."
        named = tuple(dict.fromkeys(facts.path(iri) for iri in places))
        return InterpretedAnswer(
            f"where: {things.text}", self._things.located(things.iris), sentence=sentence, places=named
        )

    def _volume(self, iri: str) -> float:
        """Return the volume of the box of an object in m³, infinite without one."""
        extents = self._facts.body(iri).extents
        return math.prod(extents) if extents is not None else math.inf

    def _stands_on(self, thing: str) -> InterpretedAnswer:
        facts, things = self._facts, self._nouns.find(thing)
        rooms = {room for iri in things.iris for room in facts.anchors("room", iri)}
        held = [
            (name, anchor)
            for iri in things.iris
            for name in ("on", "inside", "attached")
            for anchor in facts.anchors(name, iri)
            if anchor not in rooms
        ]
        # What is on a thing is not asked about where it is in or attached to another.
        first = held[0][0] if held else ""
        anchors = [anchor for name, anchor in held if name == first]
        if not anchors:
            raise GraphError(f"not known: the graph does not state what {things.text} is on{things.suffix}")
        verb = "are" if len(things.iris) > 1 else "is"
        named = join_few([the_thing(facts.kind(anchor), facts.label(anchor)) for anchor in dict.fromkeys(anchors)])
        sentence = begin_sentence(f"{things.text} {verb} {PREPOSITIONS[first]} {named}{things.suffix}.")
        return InterpretedAnswer(f"what {things.text} is on", self._things.located(anchors), sentence=sentence)

    def _parts_of(self, kind: str, thing: str) -> InterpretedAnswer:
        wholes, what = self._nouns.find(thing), self._nouns.find(kind)
        if not wholes.iris:
            if self._nouns.is_whole_scene(wholes.text):
                return self._how_many(kind)
            raise GraphError(wholes.absence)
        parts = find_related(self._facts, "part", wholes.iris, is_direct=True)
        if not parts:
            raise GraphError(f"not known: the graph states no parts of {wholes.text} as objects of their own")
        if not what.iris:
            raise GraphError(what.absence)
        chosen = [iri for iri in what.iris if iri in parts]
        sentence = f"{begin_sentence(self._things.the(wholes))} has {count_phrase(len(chosen), what.text)}."
        return InterpretedAnswer(
            f"{what.text} that are parts of {wholes.text}",
            self._things.located(chosen),
            number=len(chosen),
            sentence=sentence,
        )

    def _parts_list(self, kind: str, thing: str) -> InterpretedAnswer:
        if self._nouns.is_whole_scene(" ".join(split_phrase(thing))):
            return self._all(kind)
        return self._parts_of(kind, thing)

    def _with_parts(self, kind: str, other: str, count: str = "") -> InterpretedAnswer:
        """Return the things that have parts of a kind: any, or as many as the question names."""
        number, noun = split_number(other)
        things, parts = self._nouns.find(kind), set(self._nouns.find(noun).iris)
        is_counted = bool(count) or noun != other
        own = {iri: len(parts & find_parts(self._facts, [iri])) for iri in things.iris}
        chosen = [iri for iri, many in own.items() if (many == number if is_counted else many)]
        if not any(own.values()):
            return self._which(kind, f"with {other}")
        named = Things(tuple(chosen), f"{things.text} with {other}", things.note)
        return self._things.answer(named)

    def _which(self, kind: str, other: str) -> InterpretedAnswer:
        self._nouns.existing(kind)
        return self._things.answer(self._nouns.find(f"{kind} {other}"))

    def _has_parts(self, kind: str, thing: str) -> InterpretedAnswer:
        found = self._parts_of(kind, thing)
        yes = bool(found.number)
        sentence = yes_or_no(yes, found.sentence)
        return InterpretedAnswer(f"whether there are {found.understood}", found.answer, yes, sentence=sentence)

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
        text = next(q.text for q in list_questions() if q.id == question)
        parameters = ", ".join(f"{name} = {value}" for name, value in values.items())
        understood = f"{question}: {text}{f' with {parameters}' if parameters else ''}"
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
