"""SPARQL templates of the short questions: on, in, attached to, near, above, parts of X, where is X, all of KIND."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from usd2kg.errors import GraphError
from usd2kg.query.lookup.object_columns import NEAR_PROPERTIES
from usd2kg.query.lookup.prepositions import preposition_pattern

__all__ = [
    "ABOVE",
    "ALL_INSIDE",
    "ALL_OF",
    "ALL_ON",
    "ATTACHED",
    "INSIDE",
    "KIND_OF",
    "NEAR",
    "ON",
    "PARTS_OF",
    "WHERE_IS",
    "QueryTemplate",
    "parse_question",
]

_ON = "soma:isOntopOf|u2k:on"
_INSIDE = "soma:isInsideOf|u2k:inside"
_ATTACHED = "u2k:attachedTo"
_WITHIN = f"{_INSIDE}|u2k:inRoom"
_NEAR = "|".join(map(str, NEAR_PROPERTIES))
_PART_OF = "^soma:hasPhysicalComponent|u2k:partOf"
_ABOVE = f"(knowrob:isAboveOf|u2k:above)/({_ON})*"
"""The graph states only the nearest anchors, but an object above another on the table is also above the table."""

KIND_OF = "(a/rdfs:subClassOf*)|(u2k:concept/skos:broader*)"
"""From an object to a class that it belongs to, or to its concept and the hypernyms."""

# The engine joins the groups below OPTIONAL before it looks at what is around them. So each group that has an
# annotation begins with the pairs that are asked about; without them, it would read all annotations of the graph.
_PAIRS = "{{ SELECT DISTINCT ?o ?a {{ VALUES ?a {{ {things} }} ?o {predicate} ?a }} }}"
"""An object and the thing that it stands in a relation to."""
_CLASS = "OPTIONAL {{ ?o a ?c . ?c rdfs:label ?class . }}"

_RELATED = f"""
SELECT DISTINCT ?object ?class ?path ?anchor ?number WHERE {{{{
  {_PAIRS}
  ?o rdfs:label ?object ; u2k:primPath ?path .
  ?a rdfs:label ?anchor .
  {_CLASS}
  OPTIONAL {{{{
    {_PAIRS}
    ?x owl:annotatedSource ?o ; owl:annotatedTarget ?a ; {{number}} ?number .
  }}}}
}}}} ORDER BY ?path"""

_CLOSE = f"""
SELECT ?object ?class ?path ?anchor (MIN(?measured) AS ?number) WHERE {{{{
  {_PAIRS}
  ?o rdfs:label ?object ; u2k:primPath ?path .
  ?a rdfs:label ?anchor .
  {_CLASS}
  OPTIONAL {{{{
    {{{{
      {_PAIRS}
      ?x owl:annotatedSource ?o ; owl:annotatedTarget ?a ; u2k:distance|u2k:gap ?measured .
    }}}} UNION {{{{
      {_PAIRS}
      ?x owl:annotatedSource ?a ; owl:annotatedTarget ?o ; u2k:distance|u2k:gap ?measured .
    }}}}
  }}}}
}}}} GROUP BY ?o ?a ?object ?class ?path ?anchor ORDER BY ?number ?path"""

_PARTS = f"""
SELECT DISTINCT ?object ?class ?path ?whole WHERE {{{{
  {{{{ SELECT DISTINCT ?o {{{{ VALUES ?a {{{{ {{things}} }}}} ?o ({{predicate}})+ ?a }}}} }}}}
  ?o rdfs:label ?object ; u2k:primPath ?path ; {{predicate}} ?w .
  ?w rdfs:label ?whole .
  {_CLASS}
}}}} ORDER BY ?path"""

_WHERE = f"""
SELECT DISTINCT ?object ?class ?path ?center ?on ?inside ?attached ?room WHERE {{{{
  VALUES ?o {{{{ {{things}} }}}}
  ?o rdfs:label ?object ; u2k:primPath ?path .
  {_CLASS}
  OPTIONAL {{{{ ?o (soma:hasShape/dul:hasRegion)?/u2k:boxCenter ?center . }}}}
  OPTIONAL {{{{ ?o {{on}} ?a . ?a rdfs:label ?on . }}}}
  OPTIONAL {{{{ ?o {{inside}} ?b . ?b rdfs:label ?inside . }}}}
  OPTIONAL {{{{ ?o {{attached}} ?d . ?d rdfs:label ?attached . }}}}
  OPTIONAL {{{{ ?o u2k:inRoom ?r . ?r rdfs:label ?room . }}}}
}}}} ORDER BY ?path"""

_ALL = f"""
SELECT DISTINCT ?object ?class ?concept ?path ?confidence WHERE {{{{
  {_PAIRS}
  ?o rdfs:label ?object ; u2k:primPath ?path .
  {_CLASS}
  OPTIONAL {{{{ ?o u2k:concept/skos:prefLabel ?concept . }}}}
  OPTIONAL {{{{ SELECT ?o (MAX(?stated) AS ?of_class) {{{{
    {_PAIRS}
    ?o a ?k . ?k rdfs:subClassOf* ?a .
    ?x owl:annotatedSource ?o ; owl:annotatedTarget ?k ; sssom:confidence ?stated .
  }}}} GROUP BY ?o }}}}
  OPTIONAL {{{{ ?o u2k:conceptConfidence ?of_concept . }}}}
  BIND (COALESCE(?of_class, ?of_concept) AS ?confidence)
}}}} ORDER BY ?path"""


@dataclass(frozen=True)
class QueryTemplate:
    """A query about given objects, or about the objects of given kinds."""

    text: str
    """SPARQL as a format string."""
    terms: Mapping[str, str]
    """Placeholder → property path."""
    columns: Mapping[str, str] = field(default_factory=dict)
    """Variable → column of the answer, if they differ."""
    takes_kind: bool = False
    """Whether the query is about classes and concepts."""

    def fill(self, things: str) -> str:
        """Return the query about objects or kinds, given as SPARQL terms (see `term_list`)."""
        return self.text.format(things=things, **self.terms)


ON = QueryTemplate(_RELATED, {"predicate": _ON, "number": "u2k:gap"}, {"number": "gap_m"})
INSIDE = QueryTemplate(_RELATED, {"predicate": _WITHIN, "number": "u2k:insideRatio"}, {"number": "inside_ratio"})
ALL_ON = QueryTemplate(_RELATED, {"predicate": f"({_ON})+", "number": "u2k:gap"}, {"number": "gap_m"})
"""On an object, directly or via objects on it."""
ALL_INSIDE = QueryTemplate(
    _RELATED,
    {"predicate": f"({_ON}|{_INSIDE})*/({_WITHIN})", "number": "u2k:insideRatio"},
    {"number": "inside_ratio"},
)
"""Inside an object, or on or in objects inside it."""
ATTACHED = QueryTemplate(_RELATED, {"predicate": _ATTACHED, "number": "u2k:gap"}, {"number": "gap_m"})
ABOVE = QueryTemplate(_RELATED, {"predicate": _ABOVE, "number": "u2k:gap"}, {"number": "gap_m"})
NEAR = QueryTemplate(_CLOSE, {"predicate": _NEAR}, {"number": "distance_m"})
PARTS_OF = QueryTemplate(_PARTS, {"predicate": _PART_OF})
WHERE_IS = QueryTemplate(
    _WHERE, {"on": _ON, "inside": _INSIDE, "attached": _ATTACHED}, {"center": "center_m", "attached": "attached_to"}
)
ALL_OF = QueryTemplate(_ALL, {"predicate": KIND_OF}, takes_kind=True)

_PHRASES = (
    (rf"(what\s+(is|stands|lies)\s+)?({preposition_pattern(['on'])})\s+(?P<thing>.+)", ON),
    (rf"(what\s+is\s+)?({preposition_pattern(['inside'])})\s+(?P<thing>.+)", INSIDE),
    (rf"(what\s+(is\s+)?)?({preposition_pattern(['attached'])})\s+(?P<thing>.+)", ATTACHED),
    (rf"(what\s+is\s+)?({preposition_pattern(['near'])})\s+(?P<thing>.+)", NEAR),
    (rf"(what\s+is\s+)?({preposition_pattern(['above'])})\s+(?P<thing>.+)", ABOVE),
    (r"(what\s+are\s+)?(the\s+)?parts(\s+of|-of)\s+(?P<thing>.+)", PARTS_OF),
    (r"where(\s+is|\s+are|-is|'s)?\s+(?P<thing>.+)", WHERE_IS),
    (r"all(\s+of|-of)?\s+(?P<thing>.+)", ALL_OF),
)


def parse_question(words: Sequence[str]) -> tuple[QueryTemplate, str]:
    """Return the template for a short question, and the name of its subject.

    >>> parse_question(["what", "is", "on", "the table?"])[1]
    'the table'

    Raises:
        GraphError: the question is not understood.
    """
    text = " ".join(words).strip().rstrip("?").strip()
    for pattern, question in _PHRASES:
        found = re.fullmatch(pattern, text, flags=re.IGNORECASE)
        if found:
            return question, found.group("thing").strip()
    raise GraphError(
        f"question {text!r} is not understood; expected 'on X', 'in X', 'attached to X', 'near X', 'above X', "
        "'parts of X', 'where is X' or 'all of KIND', or a query with --sparql"
    )
