"""usd2kg query: ask a graph."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.options import JsonOutput, SceneName
from usd2kg.cli.output import emit, format_table, print_json
from usd2kg.errors import GraphError

if TYPE_CHECKING:
    from usd2kg.query import Answer

__all__ = ["answer_text", "query_command", "query_text"]


def query_command(
    graph: Annotated[
        str | None,
        typer.Argument(
            metavar="GRAPH",
            help="A graph that usd2kg build wrote, the folder of a store, or the address of a server; not needed for "
            "--list.",
        ),
    ] = None,
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[QUESTION]...",
            help="on X, in X, near X, above X, parts of X, where is X, or all of CLASS (subclasses included).",
        ),
    ] = None,
    sparql: Annotated[
        str | None, typer.Option("--sparql", help="A SPARQL query, or @FILE to read one; usual prefixes are known.")
    ] = None,
    question: Annotated[
        str | None, typer.Option("--question", "-q", metavar="ID", help="One of the questions of --list.")
    ] = None,
    given: Annotated[
        list[str] | None,
        typer.Option("--with", metavar="NAME=VALUE", help="Value for a parameter of --question; repeatable."),
    ] = None,
    is_list: Annotated[
        bool, typer.Option("--list", help="List the questions with their parameters, and stop.")
    ] = False,
    scene: SceneName = None,
    json: JsonOutput = False,
) -> None:
    """Ask a graph: a ready question in words, one of the listed questions, or a SPARQL query."""
    from usd2kg.stores import is_store, open_graph, open_store, select_graphs  # noqa: PLC0415

    if is_list:
        _print_questions(json)
        return
    if graph is None or (sparql is not None) + (question is not None) + bool(words) != 1:
        raise GraphError(
            "query: expected a graph and either a question, like 'on table', --question with an ID of --list, "
            "or --sparql with a query"
        )
    if given and question is None:
        raise GraphError("query: --with gives a value to a parameter of --question; expected --question ID beside it")
    if sparql is not None and is_store(graph):
        # A server answers by itself: what it holds may be more than this machine's memory.
        kept = open_store(graph)
        answer = kept.query(query_text(sparql), select_graphs(kept, scene))
    elif sparql is not None:
        answer = open_graph(graph, scene).sparql(query_text(sparql))
    elif question is not None:
        answer = open_graph(graph, scene).answer(question, dict(map(_parse_given, given or [])))
    else:
        answer = open_graph(graph, scene).ask(words or [])
    if json:
        print_json([dict(zip(answer.columns, row, strict=True)) for row in answer.values])
    else:
        emit(answer_text(answer), None)


def _print_questions(as_json: bool) -> None:
    from usd2kg.query.questions import list_questions  # noqa: PLC0415

    questions = list_questions()
    if as_json:
        print_json(
            [
                {
                    "id": question.id,
                    "question": question.text,
                    "parameters": [{"name": p.name, "kind": p.kind, "default": p.default} for p in question.parameters],
                    "note": question.note,
                }
                for question in questions
            ]
        )
        return
    rows = [
        (question.id, " ".join(_parameter_text(p.name, p.kind, p.default) for p in question.parameters), question.text)
        for question in questions
    ]
    emit(format_table(("id", "parameters", "question"), rows), None)


def _parameter_text(name: str, kind: str, default: str | None) -> str:
    """Return a parameter as a person would give it: its default, or its kind where it must be given."""
    unit = f" {kind}" if kind in {"m", "kg"} else ""
    return f"{name}={kind.upper()}" if default is None else f"[{name}={default}{unit}]"


def _parse_given(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not value.strip():
        raise GraphError(f"--with {text}: expected NAME=VALUE, like --with thing=table")
    return name.strip(), value.strip()


def query_text(sparql: str) -> str:
    """Return a query as it was given, or read from the file in @FILE."""
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
