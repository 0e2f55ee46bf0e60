"""From a Scene and its Grounding to RDF: individuals, relations, provenance, files and questions."""

from usd2kg.graph.answer import Answer
from usd2kg.graph.document import RDF_FORMATS, GraphDocument, GraphPart, document_of, rdf_format, read_document
from usd2kg.graph.functions import FUNCTION_NAMESPACE, FUNCTIONS
from usd2kg.graph.instantiate import PROFILES, KnowledgeGraph, instantiate
from usd2kg.graph.iris import individual_iri, prim_path_of
from usd2kg.graph.json_ld import CONTEXTS, context_text
from usd2kg.graph.load import load_graph
from usd2kg.graph.lookup import term_list
from usd2kg.graph.merge import merge_imports
from usd2kg.graph.neo4j import write_neo4j
from usd2kg.graph.options import ANNOTATIONS, COLORS, GraphOptions, read_epoch, read_time
from usd2kg.graph.property_graph import PropertyEdge, PropertyGraph, PropertyNode, read_property_graph
from usd2kg.graph.query import GraphStore
from usd2kg.graph.questions import Parameter, Question, list_questions
from usd2kg.graph.relations import Relation, RelationOptions, find_relations
from usd2kg.graph.serialize import GRAPH_FORMATS, GraphFormat, graph_format, serialize_graph, write_graph
from usd2kg.graph.sssom import UNSPECIFIED_LICENSE, format_sssom
from usd2kg.graph.terms import VOCABULARY_IRI, vocabulary_text

__all__ = [
    "ANNOTATIONS",
    "COLORS",
    "CONTEXTS",
    "FUNCTIONS",
    "FUNCTION_NAMESPACE",
    "GRAPH_FORMATS",
    "PROFILES",
    "RDF_FORMATS",
    "UNSPECIFIED_LICENSE",
    "VOCABULARY_IRI",
    "Answer",
    "GraphDocument",
    "GraphFormat",
    "GraphOptions",
    "GraphPart",
    "GraphStore",
    "KnowledgeGraph",
    "Parameter",
    "PropertyEdge",
    "PropertyGraph",
    "PropertyNode",
    "Question",
    "Relation",
    "RelationOptions",
    "context_text",
    "document_of",
    "find_relations",
    "format_sssom",
    "graph_format",
    "individual_iri",
    "instantiate",
    "list_questions",
    "load_graph",
    "merge_imports",
    "prim_path_of",
    "rdf_format",
    "read_document",
    "read_epoch",
    "read_property_graph",
    "read_time",
    "serialize_graph",
    "term_list",
    "vocabulary_text",
    "write_graph",
    "write_neo4j",
]
