"""GraphStore: a graph with its queries."""

import itertools
import logging
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import pyoxigraph as ox

from usd2kg.errors import GraphError, one_line
from usd2kg.query import query_templates as templates
from usd2kg.query.answer import Answer, join_answers, make_answer, with_columns
from usd2kg.query.bodies import BodyIndex
from usd2kg.query.body_table import parse_vector
from usd2kg.query.complexity import check_complexity
from usd2kg.query.dataset import QUERY_PREFIXES, Dataset, term_list, with_prefixes
from usd2kg.query.functions import make_functions
from usd2kg.query.lookup import Nouns, SceneFacts, UnknownWordError
from usd2kg.query.questions import Parameter, Question, find_question, parse_number
from usd2kg.query.remote_clauses import REMOTE_QUERY, has_remote_clause
from usd2kg.query.settings import LOOKUP
from usd2kg.query.sparql_errors import describe_syntax_error, unknown_graphs, unknown_names
from usd2kg.query.staging import list_found_first
from usd2kg.query.unicode_text import check_text

__all__ = ["GraphStore"]

logger = logging.getLogger(__name__)

_Terms = tuple[ox.NamedNode | ox.Literal, ...]
"""What a parameter of a question is bound to: one term, or all classes and concepts of a name."""


class GraphStore:
    """An immutable graph that answers SPARQL queries and ready questions."""

    def __init__(self, dataset: Dataset, source: str, keeper: object = None) -> None:
        """Wrap a dataset.

        Args:
            dataset: the graph, in memory or on disk.
            source: the file or store that it was read from.
            keeper: what has to exist as long as the graph is used, see `release_when_unused`.
        """
        self._dataset = dataset
        self._source = source
        self._bodies = BodyIndex(dataset)
        self._functions = make_functions(dataset, self._bodies)
        self._facts = SceneFacts(dataset, self._bodies)
        self._keeper = keeper

    @classmethod
    def from_triples(cls, triples: Iterable[ox.Triple], source: str) -> "GraphStore":
        """Return the graph of some triples, in memory.

        Args:
            triples: the graph.
            source: the file that it describes.
        """
        store = ox.Store()
        store.bulk_extend(ox.Quad(t.subject, t.predicate, t.object) for t in triples)
        return cls(Dataset(store), source)

    def __len__(self) -> int:
        """Return the number of triples."""
        return len(self._dataset)

    @property
    def store(self) -> ox.Store:
        """The store; of several graphs in it, `dataset` has those of the graph."""
        return self._dataset.store

    @property
    def dataset(self) -> Dataset:
        """The triples; read-only."""
        return self._dataset

    @property
    def source(self) -> str:
        """The file or store that the graph was read from."""
        return self._source

    @property
    def bodies(self) -> BodyIndex:
        """Boxes, extents, masses and joints of the objects."""
        return self._bodies

    @property
    def facts(self) -> SceneFacts:
        """Names, kinds, looks and relations of the objects, read when they are needed."""
        return self._facts

    def sparql(self, query: str) -> Answer:
        """Return the answer to a SPARQL 1.1 query.

        The package's functions and prefixes, and the prefixes of the user's ontology are predefined.

        Raises:
            GraphError: the query does not parse, is an update, is too complex, or contacts another server.
        """
        check_complexity(query)
        found = self._run(query)
        own = {name: iri for name, iri in self._dataset.prefixes.items() if name not in QUERY_PREFIXES}
        return replace(found, sparql=with_prefixes(query, own))

    def hints(self, query: str) -> list[str]:
        """Return a line for each name in a query that the graph does not have: a misspelt property, a graph of FROM."""
        return [*unknown_graphs(query, self._dataset), *unknown_names(query, self._dataset)]

    def answer(self, question_id: str, given: Mapping[str, str] | None = None) -> Answer:
        """Return the answer to one of `list_questions`, with values for its parameters.

        If a name matches several objects, the question is answered for each, and a last column names the object.

        Raises:
            GraphError: the question, a parameter or the object is unknown, or a value does not parse.
        """
        question = find_question(question_id)
        for name, value in (given or {}).items():
            check_text(value, name)
        filled = question.fill(given or {})
        choices = [self._terms_or_advice(question, p, value, given or {}) for p, value in filled.items()]
        ambiguous = [p for p, terms in zip(filled, choices, strict=True) if p.kind == "object" and len(terms) > 1]
        answers = []
        for terms in itertools.product(*choices):
            bound = dict(zip(filled, terms, strict=True))
            found = self._run_staged(question.bind(bound, self._candidates(question, bound)))
            answers.append(with_columns(found, {p.name: self._facts.label(str(bound[p][0].value)) for p in ambiguous}))
        return join_answers(answers)

    def _candidates(self, question: Question, bound: Mapping[Parameter, _Terms]) -> Sequence[ox.NamedNode] | None:
        """Return the objects within the distance that the question allows; None if these are too many to list."""
        if question.candidates is None:
            return None
        distance, origin = ({p.name: terms[0] for p, terms in bound.items()}[name] for name in question.candidates)
        found = self._bodies.within(float(distance.value), str(origin.value))
        return None if found is None or len(found) > LOOKUP.max_listed else [*map(ox.NamedNode, found)]

    def _terms_or_advice(
        self, question: Question, parameter: Parameter, value: str, given: Mapping[str, str]
    ) -> Sequence[_Terms]:
        """Return what a value can denote; the error about a default that a graph lacks names the option."""
        try:
            return self._terms(parameter, value)
        except UnknownWordError as error:
            if parameter.name in given:
                raise
            option = f"--with {parameter.name}={parameter.kind.upper()}"
            raise UnknownWordError(f"question {question.id} needs {option} for this graph: {error}") from error

    def _terms(self, parameter: Parameter, value: str) -> Sequence[_Terms]:
        """Return what a value can denote; the question is asked for each."""
        if parameter.kind == "object":
            return [(node,) for node in self.find(value)]
        if parameter.kind == "class":
            return [tuple(self._kinds(value))]
        if parameter.kind == "position":
            if parse_vector(value) is None:
                raise GraphError(f"{parameter.name} {value!r} is not a position; expected x y z in metres: '1 0.5 2'")
            return [(ox.Literal(value),)]
        return [(ox.Literal(parse_number(value, parameter.kind)),)]

    def _run_staged(self, query: str) -> Answer:
        """Return the answer to a query of this package, quickly where it is about few objects."""
        staged = list_found_first(query, self._dataset.select, LOOKUP.max_listed)
        return replace(self._run(staged), sparql=query)

    def _run(self, query: str) -> Answer:
        if has_remote_clause(query):
            raise GraphError(REMOTE_QUERY)
        try:
            found = self._dataset.query(query, custom_functions=self._functions)
        except SyntaxError as error:
            raise GraphError(describe_syntax_error(query, error, self._dataset.prefixes)) from error
        except RuntimeError as error:
            raise GraphError(f"query: cannot be answered ({one_line(error)})") from error
        if isinstance(found, ox.QueryBoolean):
            return Answer(("answer",), ((str(bool(found)).lower(),),), ((bool(found),),), query)
        if isinstance(found, ox.QueryTriples):
            triples = sorted((tuple(triple) for triple in found), key=lambda triple: [str(term) for term in triple])
            return make_answer(("subject", "predicate", "object"), triples, query)
        columns = tuple(variable.value for variable in found.variables)
        return make_answer(columns, [tuple(solution[c] for c in columns) for solution in found], query)

    def on(self, thing: str, *, is_direct: bool = True) -> Answer:
        """Return the objects on `thing`.

        Args:
            thing: prim path, label, class or words, see `find`.
            is_direct: whether to return only objects directly on it; otherwise also those on other objects on it.
        """
        return self._about(templates.ON if is_direct else templates.ALL_ON, thing)

    def inside(self, thing: str, *, is_direct: bool = True) -> Answer:
        """Return the objects inside `thing`, which may be a room; if not `is_direct`, also objects on or in those."""
        return self._about(templates.INSIDE if is_direct else templates.ALL_INSIDE, thing)

    def where_is(self, thing: str) -> Answer:
        """Return the location of `thing`: centre of its box in metres, supporters, containers and room."""
        return self._about(templates.WHERE_IS, thing)

    def near(self, thing: str) -> Answer:
        """Return the objects near, next to or touching `thing`, nearest first."""
        return self._about(templates.NEAR, thing)

    def above(self, thing: str) -> Answer:
        """Return the objects above `thing`, or above an object on it."""
        return self._about(templates.ABOVE, thing)

    def parts_of(self, thing: str) -> Answer:
        """Return the parts of `thing`, recursively."""
        return self._about(templates.PARTS_OF, thing)

    def all_of(self, name: str) -> Answer:
        """Return the objects of a class or concept, with everything below it.

        A class is named by label, local name, CURIE or IRI; a concept by a noun, such as `book` or `couch`. A noun that
        names both means both.
        """
        return self._about(templates.ALL_OF, name)

    def ask(self, words: Sequence[str]) -> Answer:
        """Return the answer to a short question: `on X`, `in X`, `near X`, `parts of X`, `all of KIND`.

        Raises:
            GraphError: the question is not understood, or the object or kind is not in the graph.
        """
        return self._about(*templates.parse_question(words))

    def find(self, thing: str) -> list[ox.NamedNode]:
        """Return the objects that a name or a noun phrase means, as for `ask`: see `Nouns.find`.

        Words that are read in another way than written are logged.

        Raises:
            GraphError: a word is not understood, or there is no such object.
        """
        check_text(thing, "name")
        expected = "expected a label, a class, a noun or a prim path; usd2kg query GRAPH all of KIND lists objects"
        try:
            things = Nouns(self._facts).find(thing)
        except GraphError as error:
            raise GraphError(f"{self._source}: {error}; {expected}") from error
        if not things.iris:
            raise GraphError(f"{self._source}: there is no {things.text}; {expected}")
        if things.note:
            logger.warning("%s: %s", self._source, things.note)
        return [*map(ox.NamedNode, things.iris)]

    def _kinds(self, name: str) -> list[ox.NamedNode]:
        try:
            return Nouns(self._facts).kinds(name)
        except UnknownWordError as error:
            raise UnknownWordError(f"{self._source}: {error}") from error

    def _about(self, template: templates.QueryTemplate, name: str) -> Answer:
        things = self._kinds(name) if template.takes_kind else self.find(name)
        answer = self._run_staged(template.fill(term_list(things)))
        return replace(answer, columns=tuple(template.columns.get(column, column) for column in answer.columns))
