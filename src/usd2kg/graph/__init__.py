"""Scene + Grounding + relations → RDF: individuals, provenance, file formats and exports."""

from typing import TYPE_CHECKING

from usd2kg.lazy_names import lazy_names

if TYPE_CHECKING:
    from usd2kg.graph.abox import PROFILES, KnowledgeGraph, instantiate
    from usd2kg.graph.declarations import VOCABULARY_IRI, vocabulary_text
    from usd2kg.graph.export.neo4j import write_neo4j
    from usd2kg.graph.export.property_graph import PropertyEdge, PropertyGraph, PropertyNode, read_property_graph
    from usd2kg.graph.export.ros.detections import write_ros2
    from usd2kg.graph.export.ros.transforms import write_tf
    from usd2kg.graph.export.sssom import UNSPECIFIED_LICENSE, format_sssom
    from usd2kg.graph.formats.serialize import GRAPH_FORMATS, GraphFormat, graph_format, serialize_graph, write_graph
    from usd2kg.graph.import_closure import merge_imports
    from usd2kg.graph.iris import individual_iri, prim_path_of
    from usd2kg.graph.options import ANNOTATIONS, COLORS, GraphOptions, read_epoch, read_time
    from usd2kg.graph.rdf_document import RDF_FORMATS, GraphDocument, GraphPart, document_of, rdf_format, read_document

__all__ = [
    "ANNOTATIONS",
    "COLORS",
    "GRAPH_FORMATS",
    "PROFILES",
    "RDF_FORMATS",
    "UNSPECIFIED_LICENSE",
    "VOCABULARY_IRI",
    "GraphDocument",
    "GraphFormat",
    "GraphOptions",
    "GraphPart",
    "KnowledgeGraph",
    "PropertyEdge",
    "PropertyGraph",
    "PropertyNode",
    "document_of",
    "format_sssom",
    "graph_format",
    "individual_iri",
    "instantiate",
    "merge_imports",
    "prim_path_of",
    "rdf_format",
    "read_document",
    "read_epoch",
    "read_property_graph",
    "read_time",
    "serialize_graph",
    "vocabulary_text",
    "write_graph",
    "write_neo4j",
    "write_ros2",
    "write_tf",
]

__getattr__ = lazy_names(
    __name__,
    {
        "ANNOTATIONS": "options",
        "COLORS": "options",
        "GRAPH_FORMATS": "formats.serialize",
        "PROFILES": "abox",
        "RDF_FORMATS": "rdf_document",
        "UNSPECIFIED_LICENSE": "export.sssom",
        "VOCABULARY_IRI": "declarations",
        "GraphDocument": "rdf_document",
        "GraphFormat": "formats.serialize",
        "GraphOptions": "options",
        "GraphPart": "rdf_document",
        "KnowledgeGraph": "abox",
        "PropertyEdge": "export.property_graph",
        "PropertyGraph": "export.property_graph",
        "PropertyNode": "export.property_graph",
        "document_of": "rdf_document",
        "format_sssom": "export.sssom",
        "graph_format": "formats.serialize",
        "individual_iri": "iris",
        "instantiate": "abox",
        "merge_imports": "import_closure",
        "prim_path_of": "iris",
        "rdf_format": "rdf_document",
        "read_document": "rdf_document",
        "read_epoch": "options",
        "read_property_graph": "export.property_graph",
        "read_time": "options",
        "serialize_graph": "formats.serialize",
        "vocabulary_text": "declarations",
        "write_graph": "formats.serialize",
        "write_neo4j": "export.neo4j",
        "write_ros2": "export.ros.detections",
        "write_tf": "export.ros.transforms",
    },
)
