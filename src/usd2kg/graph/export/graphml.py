"""GraphML of a property graph for networkx, yEd and Gephi: typed keys, one edge per relation."""

from collections.abc import Iterator, Mapping

from usd2kg.graph.export.property_graph import PropertyGraph, Value
from usd2kg.graph.xml_text import replace_illegal_characters, xml_attribute, xml_text

__all__ = ["graphml_pieces"]

_TYPES = {str: "string", float: "double", int: "long", bool: "boolean"}
_HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
"""


def graphml_pieces(graph: PropertyGraph) -> Iterator[bytes]:
    """Yield the file in chunks.

    Node keys include `label`, the name that viewers show, and `labels`, the node labels (`:Thing:Object:Crockery:Cup`);
    the `label` of an edge is its type. Characters that are illegal in XML become U+FFFD.
    """
    nodes = {"label": str, "labels": str, **graph.property_types(of_edges=False)}
    edges = {"label": str, **graph.property_types(of_edges=True)}
    nodes.pop("name", None)
    yield _HEAD.encode()
    for domain, keys in (("node", nodes), ("edge", edges)):
        for name, kind in keys.items():
            yield (
                f'  <key id="{domain}.{name}" for="{domain}" attr.name="{name}" attr.type="{_TYPES[kind]}"/>\n'
            ).encode()
    yield b'  <graph edgedefault="directed">\n'
    for node in graph.nodes:
        values = {"label": node.properties.get("name", ""), "labels": "".join(f":{name}" for name in node.labels)}
        rest = {name: value for name, value in node.properties.items() if name != "name"}
        yield f'    <node id="{xml_attribute(node.id)}">{_data("node", {**values, **rest})}</node>\n'.encode()
    for number, edge in enumerate(graph.edges):
        ends = f'source="{xml_attribute(edge.start)}" target="{xml_attribute(edge.end)}"'
        data = _data("edge", {"label": edge.type, **edge.properties})
        yield f'    <edge id="e{number}" {ends}>{data}</edge>\n'.encode()
    yield b"  </graph>\n</graphml>\n"


def _data(domain: str, values: Mapping[str, Value]) -> str:
    return "".join(f'<data key="{domain}.{name}">{_text(value)}</data>' for name, value in values.items())


def _text(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return xml_text(replace_illegal_characters(value)) if isinstance(value, str) else repr(value)
