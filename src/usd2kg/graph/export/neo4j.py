"""CSV files of a property graph for Neo4j: typed headers for neo4j-admin, and a LOAD CSV script."""

import csv
import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from usd2kg.errors import OutputError
from usd2kg.files import write_whole
from usd2kg.graph.export.property_graph import PropertyGraph, Value

__all__ = ["NEO4J_FILES", "write_neo4j"]

NEO4J_FILES = ("nodes.csv", "relationships.csv", "load.cypher")

_TYPES = {str: "", float: ":double", int: ":long", bool: ":boolean"}
_CASTS = {str: "{}", float: "toFloat({})", int: "toInteger({})", bool: "toBoolean({})"}
_ROWS = 10_000
"""Rows per chunk."""
_HEAD = """// Loads the graph of a scene into a running Neo4j, 5.23 or later.
//
// 1. Copy nodes.csv and relationships.csv into the import folder of the database.
// 2. If names contain backslashes, set in neo4j.conf: dbms.import.csv.legacy_quote_escaping=false
// 3. Run: cypher-shell -f load.cypher
//
// For a new database of millions of nodes, this is faster:
//   neo4j-admin database import full neo4j --nodes=nodes.csv --relationships=relationships.csv \\
//     --multiline-fields=true
//
// Loading again replaces the properties of existing nodes and creates no duplicate relationships.
"""
_LABEL_STEP = "  FOREACH (x IN CASE WHEN '{name}' IN labels THEN [1] ELSE [] END | SET n:`{name}`)"


def write_neo4j(graph: PropertyGraph, folder: Path) -> tuple[Path, ...]:
    """Write nodes.csv, relationships.csv and load.cypher into a folder, created if missing; return their paths.

    Cells that look like spreadsheet formulas are not escaped, since the files are for a database.

    Raises:
        OutputError: the folder cannot be created, or a file cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be created ({error.strerror}); choose another folder") from error
    node_types = graph.property_types(of_edges=False)
    edge_types = graph.property_types(of_edges=True)
    nodes = ((node.id, ";".join(node.labels), *_cells(node.properties, node_types)) for node in graph.nodes)
    edges = ((e.start, e.end, e.type, *_cells(e.properties, edge_types)) for e in graph.edges)
    contents: tuple[Iterable[bytes], ...] = (
        _csv(("iri:ID", ":LABEL", *_header(node_types)), nodes),
        _csv((":START_ID", ":END_ID", ":TYPE", *_header(edge_types)), edges),
        (_script(graph, node_types, edge_types).encode(),),
    )
    paths = tuple(folder / name for name in NEO4J_FILES)
    for path, pieces in zip(paths, contents, strict=True):
        write_whole(path, pieces)
    return paths


def _header(types: Mapping[str, type]) -> list[str]:
    return [name + _TYPES[kind] for name, kind in types.items()]


def _cells(properties: Mapping[str, Value], types: Mapping[str, type]) -> Iterator[str]:
    for name in types:
        value = properties.get(name, "")
        yield ("true" if value else "false") if isinstance(value, bool) else str(value)


def _csv(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[bytes]:
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    for number, row in enumerate(rows, 1):
        writer.writerow(row)
        if number % _ROWS == 0:
            yield text.getvalue().encode()
            text.seek(0)
            text.truncate()
    yield text.getvalue().encode()


def _script(graph: PropertyGraph, node_types: Mapping[str, type], edge_types: Mapping[str, type]) -> str:
    labels = sorted({name for node in graph.nodes for name in node.labels})
    kinds = sorted({edge.type for edge in graph.edges})
    steps = "\n".join(_LABEL_STEP.format(name=name) for name in labels)
    relations = "\n".join(
        f"  FOREACH (x IN CASE WHEN row.`:TYPE` = '{kind}' THEN [1] ELSE [] END |\n"
        f"    MERGE (a)-[r:{kind}]->(b) SET r += values)"
        for kind in kinds
    )
    return f"""{_HEAD}
CREATE CONSTRAINT thing_iri IF NOT EXISTS FOR (n:Thing) REQUIRE n.iri IS UNIQUE;

LOAD CSV WITH HEADERS FROM 'file:///nodes.csv' AS row
CALL (row) {{
  MERGE (n:Thing {{iri: row.`iri:ID`}})
  SET n += {{{_casts(node_types)}}}
  WITH n, split(row.`:LABEL`, ';') AS labels
{steps}
}} IN TRANSACTIONS OF 1000 ROWS;

LOAD CSV WITH HEADERS FROM 'file:///relationships.csv' AS row
CALL (row) {{
  MATCH (a:Thing {{iri: row.`:START_ID`}}), (b:Thing {{iri: row.`:END_ID`}})
  WITH row, a, b, {{{_casts(edge_types)}}} AS values
{relations}
}} IN TRANSACTIONS OF 1000 ROWS;
"""


def _casts(types: Mapping[str, type]) -> str:
    cells = ((name, kind, f"row.`{name}{_TYPES[kind]}`") for name, kind in types.items())
    return ", ".join(f"{name}: {_CASTS[kind].format(cell)}" for name, kind, cell in cells)
