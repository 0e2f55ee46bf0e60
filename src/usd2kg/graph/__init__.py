"""From a Scene and its Grounding to RDF: individuals, relations, provenance, files and questions."""

from usd2kg.graph.answer import Answer
from usd2kg.graph.functions import FUNCTION_NAMESPACE, FUNCTIONS
from usd2kg.graph.instantiate import PROFILES, KnowledgeGraph, instantiate
from usd2kg.graph.iris import individual_iri, prim_path_of
from usd2kg.graph.load import load_graph
from usd2kg.graph.merge import merge_imports
from usd2kg.graph.options import ANNOTATIONS, COLORS, GraphOptions, read_epoch, read_time
from usd2kg.graph.query import GraphStore
from usd2kg.graph.questions import Parameter, Question, list_questions
from usd2kg.graph.relations import Relation, RelationOptions, find_relations
from usd2kg.graph.serialize import GRAPH_FORMATS, graph_format, serialize_graph, write_graph
from usd2kg.graph.terms import VOCABULARY_IRI, vocabulary_text

__all__ = [
    "ANNOTATIONS",
    "COLORS",
    "FUNCTIONS",
    "FUNCTION_NAMESPACE",
    "GRAPH_FORMATS",
    "PROFILES",
    "VOCABULARY_IRI",
    "Answer",
    "GraphOptions",
    "GraphStore",
    "KnowledgeGraph",
    "Parameter",
    "Question",
    "Relation",
    "RelationOptions",
    "find_relations",
    "graph_format",
    "individual_iri",
    "instantiate",
    "list_questions",
    "load_graph",
    "merge_imports",
    "prim_path_of",
    "read_epoch",
    "read_time",
    "serialize_graph",
    "vocabulary_text",
    "write_graph",
]
