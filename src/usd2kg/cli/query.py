"""usd2kg query: ask a graph."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.options import JsonOutput
from usd2kg.cli.output import emit, format_table, print_json
from usd2kg.errors import GraphError

if TYPE_CHECKING:
    from usd2kg.graph import Answer

__all__ = ["answer_text", "query_command"]


def query_command(
    graph: Annotated[Path, typer.Argument(metavar="GRAPH", help="A graph that usd2kg build wrote.")],
    question: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[QUESTION]...",
            help="on X, in X, near X, above X, parts of X, where is X, or all of CLASS (subclasses included).",
        ),
    ] = None,
    sparql: Annotated[
        str | None, typer.Option("--sparql", help="A SPARQL query, or @FILE to read one; usual prefixes are known.")
    ] = None,
    json: JsonOutput = False,
) -> None:
    """Ask a graph a ready question or a SPARQL query."""
    from usd2kg.graph import load_graph  # noqa: PLC0415

    if (sparql is None) == (not question):
        raise GraphError("query: expected either a question, like 'on table', or --sparql with a query")
    store = load_graph(graph)
    answer = store.sparql(_query_text(sparql)) if sparql is not None else store.ask(question or [])
    if json:
        print_json([dict(zip(answer.columns, row, strict=True)) for row in answer.values])
    else:
        emit(answer_text(answer), None)


def _query_text(sparql: str) -> str:
    if not sparql.startswith("@"):
        return sparql
    try:
        return Path(sparql[1:]).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GraphError(f"{sparql[1:]}: cannot be read as a query ({error})") from error


def answer_text(answer: "Answer", most: int | None = None) -> str:
    """Return an answer as a table of at most `most` rows, with a last line that counts them all."""
    count = f"{len(answer.rows)} {'row' if len(answer.rows) == 1 else 'rows'}\n"
    shown = answer.rows[:most]
    rest = f"… {len(answer.rows) - len(shown)} more\n" if len(shown) < len(answer.rows) else ""
    return (format_table(answer.columns, shown) if shown else "") + rest + count
