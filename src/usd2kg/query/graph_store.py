"""GraphStore: a graph in memory with its queries."""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import replace

import pyoxigraph as ox

from usd2kg.errors import GraphError, one_line
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.query import query_templates as templates
from usd2kg.query.answer import Answer, join_answers, make_answer, with_columns, without_columns
from usd2kg.query.bodies import parse_vector
from usd2kg.query.complexity import check_complexity
from usd2kg.query.functions import FUNCTION_NAMESPACE, make_functions
from usd2kg.query.lookup import Lookup, term_list
from usd2kg.query.questions import Parameter, find_question, parse_number
from usd2kg.query.remote_clauses import REMOTE_QUERY, has_remote_clause

__all__ = ["GraphStore"]

_PREFIXES = {**PREFIXES, "u2kf": FUNCTION_NAMESPACE}
_Term = ox.NamedNode | ox.Literal
"""A term to which a parameter of a question is bound."""


class GraphStore:
    """An immutable graph in memory that answers SPARQL queries and ready questions."""

    def __init__(self, store: ox.Store, source: str) -> None:
        self._store = store
        self._source = source
        self._functions = make_functions(store)
        self._lookup = Lookup(store, source)

    def __len__(self) -> int:
        return len(self._store)

    @property
    def store(self) -> ox.Store:
        """The triples; read-only."""
        return self._store

    @property
    def source(self) -> str:
        """The file or store that the graph was read from."""
        return self._source

    def sparql(self, query: str) -> Answer:
        """Return the answer to a SPARQL 1.1 query; the package's prefixes and functions are predefined.

        Raises:
            GraphError: the query does not parse, is an update, is too complex, or contacts another server.
        """
        check_complexity(query)
        return self._run(query, {})

    def answer(self, question_id: str, given: Mapping[str, str] | None = None) -> Answer:
        """Return the answer to one of `list_questions`, with values for its parameters.

        If a name matches several objects, the question is answered for each, and a last column names the object.

        Raises:
            GraphError: the question, a parameter or the object is unknown, or a value does not parse.
        """
        question = find_question(question_id)
        filled = question.fill(given or {})
        choices = [self._terms(parameter, value) for parameter, value in filled.items()]
        ambiguous = [p for p, terms in zip(filled, choices, strict=True) if p.kind == "object" and len(terms) > 1]
        labels = {node.value: label for node, _, label in self._lookup.objects} if ambiguous else {}
        answers = []
        for terms in itertools.product(*choices):
            bound = dict(zip(filled, terms, strict=True))
            found = self._run(question.sparql, {ox.Variable(p.variable): term for p, term in bound.items()})
            found = without_columns(found, {parameter.variable for parameter in filled})
            answers.append(with_columns(found, {p.name: labels[str(bound[p].value)] for p in ambiguous}))
        return join_answers(answers)

    def _terms(self, parameter: Parameter, value: str) -> Sequence[_Term]:
        """Return the terms that a value can denote."""
        if parameter.kind == "object":
            return self.find(value)
        if parameter.kind == "class":
            return self._lookup.kinds(value)
        if parameter.kind == "position":
            if parse_vector(value) is None:
                raise GraphError(f"{parameter.name} {value!r} is not a position; expected x y z in metres: '1 0.5 2'")
            return [ox.Literal(value)]
        return [ox.Literal(parse_number(value, parameter.kind))]

    def _run(self, query: str, bindings: Mapping[ox.Variable, _Term]) -> Answer:
        if has_remote_clause(query):
            raise GraphError(REMOTE_QUERY)
        try:
            found = self._store.query(
                query,
                prefixes=_PREFIXES,
                use_default_graph_as_union=True,
                substitutions=dict(bindings),
                custom_functions=self._functions,
            )
        except SyntaxError as error:
            reason = one_line(error)
            raise GraphError(
                f"query: not valid SPARQL ({reason}); expected SELECT, ASK, CONSTRUCT or DESCRIBE"
            ) from error
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
        """Return the objects of a class, or else of a concept, with everything below it.

        A class is named by label, local name, CURIE or IRI; a concept by a noun, such as `book` or `couch`.
        """
        return self._about(templates.ALL_OF, name)

    def ask(self, words: Sequence[str]) -> Answer:
        """Return the answer to a short question: `on X`, `in X`, `near X`, `parts of X`, `all of KIND`.

        Raises:
            GraphError: the question is not understood, or the object or kind is not in the graph.
        """
        return self._about(*templates.parse_question(words))

    def find(self, thing: str) -> list[ox.NamedNode]:
        """Return the objects that match a name, by the first criterion with a match.

        Criteria in order: prim path; label; class or concept, with everything below it; all words in the label; all
        words in the asset's name.

        Raises:
            GraphError: no object matches.
        """
        return self._lookup.find(thing)

    def _about(self, template: templates.QueryTemplate, name: str) -> Answer:
        things = self._lookup.kinds(name) if template.takes_kind else self._lookup.find(name)
        answer = self.sparql(template.fill(term_list(things)))
        return replace(answer, columns=tuple(template.columns.get(column, column) for column in answer.columns))
