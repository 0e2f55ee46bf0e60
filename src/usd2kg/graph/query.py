"""Asking a graph: SPARQL, and ready questions in plain words."""

import itertools
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.bodies import parse_vector
from usd2kg.graph.functions import FUNCTION_NAMESPACE, make_functions
from usd2kg.graph.questions import Parameter, find_question, parse_number
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.ontology import expand_curie
from usd2kg.words import split_identifier

__all__ = ["Answer", "GraphStore", "load_graph"]

_INPUT_FORMATS = {
    ".ttl": ox.RdfFormat.TURTLE,
    ".nt": ox.RdfFormat.N_TRIPLES,
    ".rdf": ox.RdfFormat.RDF_XML,
    ".owl": ox.RdfFormat.RDF_XML,
    ".nq": ox.RdfFormat.N_QUADS,
    ".trig": ox.RdfFormat.TRIG,
    ".jsonld": ox.RdfFormat.JSON_LD,
}
_QUOTED = re.compile(r"<[^<>\s]*>|\"(?:\\\\.|[^\"\\\\])*\"|'(?:\\\\.|[^'\\\\])*'|#[^\n]*")
"""IRIs, strings and comments: where a keyword is none."""
_PREFIXES = {**PREFIXES, "u2kf": FUNCTION_NAMESPACE}
_ON = "soma:isOntopOf|u2k:on"
_INSIDE = "soma:isInsideOf|u2k:inside"
_NEAR = "dul:nearTo|knowrob:isNextTo|dul:hasCommonBoundary|u2k:near|u2k:nextTo|u2k:touching"
_PART_OF = "^soma:hasPhysicalComponent|u2k:partOf"
_ABOVE = f"(knowrob:isAboveOf|u2k:above)/({_ON})*"
"""What is above a thing on the table is above the table, though only the nearest is written."""

_RELATED = """
SELECT DISTINCT ?object ?class ?path ?anchor ?number WHERE {{
  VALUES ?a {{ {anchors} }}
  ?o {predicate} ?a ; rdfs:label ?object ; u2k:primPath ?path .
  ?a rdfs:label ?anchor .
  OPTIONAL {{ ?o a ?c . ?c rdfs:label ?class . }}
  OPTIONAL {{ ?x owl:annotatedSource ?o ; owl:annotatedTarget ?a ; {number} ?number . }}
}} ORDER BY ?path"""

_CLOSE = """
SELECT ?object ?class ?path ?anchor (MIN(?measured) AS ?number) WHERE {{
  VALUES ?a {{ {anchors} }}
  ?o {predicate} ?a ; rdfs:label ?object ; u2k:primPath ?path .
  ?a rdfs:label ?anchor .
  OPTIONAL {{ ?o a ?c . ?c rdfs:label ?class . }}
  OPTIONAL {{
    {{ ?x owl:annotatedSource ?o ; owl:annotatedTarget ?a }}
    UNION {{ ?x owl:annotatedSource ?a ; owl:annotatedTarget ?o }}
    ?x u2k:distance|u2k:gap ?measured .
  }}
}} GROUP BY ?o ?a ?object ?class ?path ?anchor ORDER BY ?number ?path"""

_PARTS = """
SELECT DISTINCT ?object ?class ?path ?whole WHERE {{
  VALUES ?a {{ {wholes} }}
  ?o ({part_of})+ ?a ; rdfs:label ?object ; u2k:primPath ?path ; {part_of} ?w .
  ?w rdfs:label ?whole .
  OPTIONAL {{ ?o a ?c . ?c rdfs:label ?class . }}
}} ORDER BY ?path"""

_WHERE = """
SELECT DISTINCT ?object ?class ?path ?center ?on ?inside ?room WHERE {{
  VALUES ?o {{ {things} }}
  ?o rdfs:label ?object ; u2k:primPath ?path .
  OPTIONAL {{ ?o a ?c . ?c rdfs:label ?class . }}
  OPTIONAL {{ ?o (soma:hasShape/dul:hasRegion)?/u2k:boxCenter ?center . }}
  OPTIONAL {{ ?o {on} ?a . ?a rdfs:label ?on . }}
  OPTIONAL {{ ?o {inside} ?b . ?b rdfs:label ?inside . }}
  OPTIONAL {{ ?o u2k:inRoom ?r . ?r rdfs:label ?room . }}
}} ORDER BY ?path"""

_ALL = """
SELECT DISTINCT ?object ?class ?path ?confidence WHERE {{
  VALUES ?wanted {{ {classes} }}
  ?c rdfs:subClassOf* ?wanted ; rdfs:label ?class .
  ?o a ?c ; rdfs:label ?object ; u2k:primPath ?path .
  OPTIONAL {{ ?x owl:annotatedSource ?o ; owl:annotatedTarget ?c ; sssom:confidence ?confidence . }}
}} ORDER BY ?path"""


_MEMBERS = """
SELECT DISTINCT ?o ?p WHERE {{
  VALUES ?wanted {{ {classes} }}
  ?o a/rdfs:subClassOf* ?wanted ; u2k:primPath ?p .
}} ORDER BY ?p"""


_Term = ox.NamedNode | ox.Literal
"""What a parameter of a question is bound to."""
Value = str | float | int | bool | None


@dataclass(frozen=True)
class Answer:
    """A table of results."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str | None, ...], ...]
    """Values as text; None where a row has none."""
    values: tuple[tuple[Value, ...], ...]
    """The same with numbers and truth values as such."""
    sparql: str
    """The query that was run."""


class GraphStore:
    """A graph in memory that answers questions. It never changes."""

    def __init__(self, store: ox.Store, source: str) -> None:
        self._store = store
        self._source = source
        self._functions = make_functions(store)

    def __len__(self) -> int:
        return len(self._store)

    @property
    def store(self) -> ox.Store:
        """The triples, to be read only."""
        return self._store

    @property
    def source(self) -> str:
        """The file that the graph was read from."""
        return self._source

    def sparql(self, query: str) -> Answer:
        """Return the answer to a SPARQL 1.1 query; our usual prefixes need no declaration, our functions are known.

        Raises:
            GraphError: the query does not parse, or updates.
        """
        return self._run(query, {})

    def answer(self, question_id: str, given: Mapping[str, str] | None = None) -> Answer:
        """Return the answer to one of `list_questions`, with values for its parameters.

        Where a name means several objects, it is asked for each, and a last column says for which a row is.

        Raises:
            GraphError: the question, a parameter or what it names is unknown, or a number is none.
        """
        question = find_question(question_id)
        filled = question.fill(given or {})
        choices = [self._terms(parameter, value) for parameter, value in filled.items()]
        told = [p for p, terms in zip(filled, choices, strict=True) if p.kind == "object" and len(terms) > 1]
        labels = {node.value: label for node, _, label in self._labels()} if told else {}
        answers = []
        for terms in itertools.product(*choices):
            bound = dict(zip(filled, terms, strict=True))
            found = self._run(question.sparql, {ox.Variable(p.variable): term for p, term in bound.items()})
            found = _without(found, {parameter.variable for parameter in filled})
            answers.append(_with(found, {p.name: labels[str(bound[p].value)] for p in told}))
        return _join(answers)

    def _terms(self, parameter: Parameter, value: str) -> Sequence[_Term]:
        """Return the terms that a value may mean."""
        if parameter.kind == "object":
            return self.find(value)
        if parameter.kind == "class":
            return self._known_classes(value)
        if parameter.kind == "position":
            if parse_vector(value) is None:
                raise GraphError(f"{parameter.name} {value!r} is no position; expected x y z in metres, like '1 0.5 2'")
            return [ox.Literal(value)]
        return [ox.Literal(parse_number(value, parameter.kind))]

    def _run(self, query: str, bindings: Mapping[ox.Variable, _Term]) -> Answer:
        if re.search(r"\bSERVICE\b", _QUOTED.sub(" ", query), flags=re.IGNORECASE):
            raise GraphError("query: SERVICE asks another server, and no query leaves this machine; take that part out")
        try:
            found = self._store.query(
                query,
                prefixes=_PREFIXES,
                use_default_graph_as_union=True,
                substitutions=dict(bindings),
                custom_functions=self._functions,
            )
        except SyntaxError as error:
            reason = " ".join(str(error).split())
            raise GraphError(
                f"query: not valid SPARQL ({reason}); only SELECT, ASK, CONSTRUCT and DESCRIBE run here"
            ) from error
        if isinstance(found, ox.QueryBoolean):
            return Answer(("answer",), ((str(bool(found)).lower(),),), ((bool(found),),), query)
        if isinstance(found, ox.QueryTriples):
            triples = sorted((tuple(triple) for triple in found), key=lambda triple: [str(term) for term in triple])
            return _answer(("subject", "predicate", "object"), triples, query)
        columns = tuple(variable.value for variable in found.variables)
        return _answer(columns, [tuple(solution[c] for c in columns) for solution in found], query)

    def on(self, thing: str) -> Answer:
        """Return what stands or lies on a thing, named by label, class, words or prim path."""
        return self._related(thing, _ON, "u2k:gap", "gap_m")

    def inside(self, thing: str) -> Answer:
        """Return what is inside a thing, or in a room."""
        return self._related(thing, f"{_INSIDE}|u2k:inRoom", "u2k:insideRatio", "inside_ratio")

    def where_is(self, thing: str) -> Answer:
        """Return where a thing is: the centre of its box in metres, what it is on and inside of, and its room."""
        things = _values(self.find(thing))
        query = _WHERE.format(things=things, on=_ON, inside=_INSIDE)
        return self._named(query, {"center": "center_m"})

    def near(self, thing: str) -> Answer:
        """Return what is near a thing, next to it or touching it, the nearest first."""
        query = _CLOSE.format(anchors=_values(self.find(thing)), predicate=_NEAR)
        return self._named(query, {"number": "distance_m"})

    def above(self, thing: str) -> Answer:
        """Return what is above a thing, or above something on it."""
        return self._related(thing, _ABOVE, "u2k:gap", "gap_m")

    def parts_of(self, thing: str) -> Answer:
        """Return the parts of a thing, and theirs."""
        return self._named(_PARTS.format(wholes=_values(self.find(thing)), part_of=_PART_OF), {})

    def all_of(self, name: str) -> Answer:
        """Return all things of a class, subclasses included; the class is named by label, local name or IRI."""
        return self._named(_ALL.format(classes=_values(self._known_classes(name))), {})

    def ask(self, words: Sequence[str]) -> Answer:
        """Return the answer to a ready question, like `on X`, `in X`, `near X`, `parts of X` or `all of CLASS`.

        Raises:
            GraphError: the question is none of these, or what it asks about is not in the graph.
        """
        question = " ".join(words).strip().rstrip("?").strip()
        for pattern, method in _QUESTIONS:
            found = re.fullmatch(pattern, question, flags=re.IGNORECASE)
            if found:
                answer: Answer = getattr(self, method)(found.group("thing").strip())
                return answer
        raise GraphError(
            f"question {question!r} is not understood; expected 'on X', 'in X', 'near X', 'above X', "
            "'parts of X', 'where is X' or 'all of CLASS', or a query with --sparql"
        )

    def find(self, thing: str) -> list[ox.NamedNode]:
        """Return the objects that a person means, by the first way that finds any.

        Ways: prim path; label; class (subclasses included); all words in the label.

        Raises:
            GraphError: there is no such thing.
        """
        thing = re.sub(r"^(the|a|an)\s+", "", thing.strip(), flags=re.IGNORECASE)
        labels = self._labels()
        wanted = _words(thing)
        ways = (
            [node for node, path, _ in labels if path == thing],
            [node for node, _, label in labels if label.lower() == thing.lower()],
            self._members(self._find_classes(thing)),
            [node for node, _, label in labels if wanted and wanted <= _words(label)],
        )
        for found in ways:
            if found:
                return found
        raise GraphError(
            f"{self._source}: nothing is called {thing!r}; expected a label, a class or a prim path, "
            "see usd2kg query GRAPH all of CLASS"
        )

    def _related(self, thing: str, predicate: str, number: str, number_name: str) -> Answer:
        query = _RELATED.format(anchors=_values(self.find(thing)), predicate=predicate, number=number)
        return self._named(query, {"number": number_name})

    def _named(self, query: str, names: dict[str, str]) -> Answer:
        answer = self.sparql(query)
        return replace(answer, columns=tuple(names.get(column, column) for column in answer.columns))

    def _labels(self) -> list[tuple[ox.NamedNode, str, str]]:
        rows = self._select("SELECT ?o ?p ?l WHERE { ?o u2k:primPath ?p ; rdfs:label ?l } ORDER BY ?p")
        return [(row["o"], row["p"].value, row["l"].value) for row in rows]

    def _select(self, query: str) -> list[Any]:
        rows = self._store.query(query, prefixes=PREFIXES)
        assert isinstance(rows, ox.QuerySolutions)
        return list(rows)

    def _known_classes(self, name: str) -> list[ox.NamedNode]:
        classes = self._find_classes(name)
        if not classes:
            raise GraphError(
                f"{self._source}: no class is called {name!r}; the graph holds {', '.join(self._class_labels())}"
            )
        return classes

    def _find_classes(self, name: str) -> list[ox.NamedNode]:
        rows = self._select("SELECT DISTINCT ?c ?l WHERE { ?c a owl:Class . OPTIONAL { ?c rdfs:label ?l } }")
        wanted = _words(name)
        iri = expand_curie(name)
        found = {
            row["c"]
            for row in rows
            if row["c"].value in {name, iri}
            or _words(re.split(r"[#/]", row["c"].value)[-1]) == wanted
            or (row["l"] is not None and _words(row["l"].value) == wanted)
        }
        return sorted(found, key=lambda node: node.value)

    def _class_labels(self) -> list[str]:
        query = "SELECT DISTINCT ?l WHERE { ?o u2k:primPath [] ; a ?c . ?c rdfs:label ?l } ORDER BY ?l"
        return [row[0] or "" for row in self.sparql(query).rows]

    def _members(self, classes: list[ox.NamedNode]) -> list[ox.NamedNode]:
        if not classes:
            return []
        return [row["o"] for row in self._select(_MEMBERS.format(classes=_values(classes)))]


_QUESTIONS = (
    (r"(what\s+(is|stands|lies)\s+)?on( top of)?\s+(?P<thing>.+)", "on"),
    (r"(what\s+is\s+)?(in|inside)( of)?\s+(?P<thing>.+)", "inside"),
    (r"(what\s+is\s+)?(near|next)( to)?\s+(?P<thing>.+)", "near"),
    (r"(what\s+is\s+)?above\s+(?P<thing>.+)", "above"),
    (r"(what\s+are\s+)?(the\s+)?parts(\s+of|-of)\s+(?P<thing>.+)", "parts_of"),
    (r"where(\s+is|\s+are|-is|'s)?\s+(?P<thing>.+)", "where_is"),
    (r"all(\s+of|-of)?\s+(?P<thing>.+)", "all_of"),
)


def _words(text: str) -> frozenset[str]:
    return frozenset(_singular(word.lower()) for word in split_identifier(text))


def _singular(word: str) -> str:
    """Return a word without its plural ending, roughly: both sides of a comparison are treated alike."""
    for ending, singular in (("ves", "f"), ("ies", "y"), ("sses", "ss"), ("xes", "x"), ("fe", "f"), ("s", "")):
        if word.endswith(ending) and len(word) > len(ending) + 2 and not word.endswith("ss"):
            return word.removesuffix(ending) + singular
    return word


def _values(nodes: Iterable[ox.NamedNode]) -> str:
    # Terms come from the store and print themselves escaped: no text of a user or a stage enters a query.
    return " ".join(str(node) for node in nodes)


def _without(answer: Answer, left_out: set[str]) -> Answer:
    kept = [index for index, column in enumerate(answer.columns) if column not in left_out]
    return replace(
        answer,
        columns=tuple(answer.columns[i] for i in kept),
        rows=tuple(tuple(row[i] for i in kept) for row in answer.rows),
        values=tuple(tuple(row[i] for i in kept) for row in answer.values),
    )


def _with(answer: Answer, added: Mapping[str, str]) -> Answer:
    """Return an answer with more columns that are alike in all rows."""
    more = tuple(added.values())
    return replace(
        answer,
        columns=(*answer.columns, *added),
        rows=tuple((*row, *more) for row in answer.rows),
        values=tuple((*row, *more) for row in answer.values),
    )


def _join(answers: Sequence[Answer]) -> Answer:
    """Return the rows of several answers to one question, each once."""
    rows = {row: value for answer in answers for row, value in zip(answer.rows, answer.values, strict=True)}
    return replace(answers[0], rows=tuple(rows), values=tuple(rows.values()))


def _answer(columns: tuple[str, ...], rows: Sequence[tuple[Any, ...]], query: str) -> Answer:
    texts = tuple(tuple(_plain(term) for term in row) for row in rows)
    values = tuple(tuple(_value(term) for term in row) for row in rows)
    return Answer(columns, texts, values, query)


def _value(term: Any) -> Value:
    """Return a term as a JSON value: numbers and truth values as such, all else as text."""
    datatype = term.datatype.value.rpartition("#")[2] if isinstance(term, ox.Literal) else ""
    if datatype in {"double", "float", "decimal"} and math.isfinite(float(term.value)):
        return float(term.value)
    if datatype in {"integer", "int", "long", "nonNegativeInteger"}:
        return int(term.value)
    if datatype == "boolean":
        return str(term.value) in {"true", "1"}
    return _plain(term)


def _plain(term: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple | None) -> str | None:
    if term is None:
        return None
    return str(term) if isinstance(term, ox.Triple) else term.value


def load_graph(path: Path | str) -> GraphStore:
    """Return the graph in a file, ready to be asked.

    Raises:
        GraphError: the file is missing, its ending names no RDF format, or it does not parse.
    """
    path = Path(path)
    rdf_format = _INPUT_FORMATS.get(path.suffix.lower())
    if path.is_dir():
        raise GraphError(f"{path}: is a folder; expected a graph that usd2kg build wrote")
    if not path.is_file():
        raise GraphError(f"{path}: no such file; expected a graph that usd2kg build wrote")
    if rdf_format is None:
        endings = ", ".join(_INPUT_FORMATS)
        raise GraphError(f"{path}: the ending {path.suffix!r} names no RDF format; expected one of {endings}")
    store = ox.Store()
    try:
        store.bulk_load(path=str(path), format=rdf_format)
    except (SyntaxError, OSError) as error:
        reason = " ".join(str(error).split())
        raise GraphError(f"{path}: does not parse as {rdf_format.name} ({reason}); build the graph again") from error
    return GraphStore(store, str(path))
