"""usd2kg query: answers from a graph."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Argument, Option

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.options.stores import OptionalGraphSource, SceneName
from usd2kg.cli.output import count_noun, emit, format_table, print_json
from usd2kg.errors import GraphError

if TYPE_CHECKING:
    from usd2kg.query import Answer

__all__ = ["answer_rows", "answer_text", "query_command", "read_sparql"]


def query_command(
    graph: OptionalGraphSource = None,
    words: Annotated[
        list[str] | None,
        Argument(
            metavar="[QUESTION]...",
            help="on X, in X, near X, above X, parts of X, where is X, or all of KIND: a class or a noun.",
        ),
    ] = None,
    sparql: Annotated[
        str | None, Option("--sparql", help="SPARQL query, or @FILE; common prefixes are predefined.")
    ] = None,
    question: Annotated[
        str | None, Option("--question", "-q", metavar="ID", help="Predefined question from --list.")
    ] = None,
    given: Annotated[
        list[str] | None, Option("--with", metavar="NAME=VALUE", help="Value of a parameter of --question. Repeatable.")
    ] = None,
    is_list: Annotated[
        bool, Option("--list", help="List the predefined questions and their parameters, and exit.")
    ] = False,
    scene: SceneName = None,
    json: JsonOutput = False,
) -> None:
    """Query a graph by a question in words, a predefined question, or SPARQL."""
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
        raise GraphError("query: --with sets a parameter of --question; expected --question ID beside it")
    if sparql is not None and is_store(graph):
        # A server evaluates the query itself; its graphs may exceed the memory here.
        store = open_store(graph)
        answer = store.query(read_sparql(sparql), select_graphs(store, scene))
    elif sparql is not None:
        answer = open_graph(graph, scene).sparql(read_sparql(sparql))
    elif question is not None:
        answer = open_graph(graph, scene).answer(question, dict(map(_parse_parameter, given or [])))
    else:
        answer = open_graph(graph, scene).ask(words or [])
    if json:
        print_json(answer_rows(answer))
    else:
        emit(answer_text(answer))


def _print_questions(is_json: bool) -> None:
    from usd2kg.query.questions import list_questions  # noqa: PLC0415

    questions = list_questions()
    if is_json:
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
    emit(format_table(("id", "parameters", "question"), rows))


def _parameter_text(name: str, kind: str, default: str | None) -> str:
    """Return a parameter as on the command line: in brackets with its default, or with its kind if required."""
    unit = f" {kind}" if kind in {"m", "kg"} else ""
    return f"{name}={kind.upper()}" if default is None else f"[{name}={default}{unit}]"


def _parse_parameter(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not equals or not value.strip():
        raise GraphError(f"--with {text}: expected NAME=VALUE, like --with thing=table")
    return name.strip(), value.strip()


def read_sparql(text: str) -> str:
    """Return a query as given, or the content of a file named as @FILE.

    Raises:
        GraphError: the file cannot be read.
    """
    if not text.startswith("@"):
        return text
    try:
        return Path(text[1:]).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GraphError(f"{text[1:]}: cannot be read as a query ({error})") from error


def answer_rows(answer: "Answer") -> list[dict[str, Any]]:
    """Return the rows of an answer by column."""
    return [dict(zip(answer.columns, row, strict=True)) for row in answer.values]


def answer_text(answer: "Answer", limit: int | None = None) -> str:
    """Return an answer as a table of at most `limit` rows, and a last line that counts all rows."""
    shown = answer.rows[:limit]
    hidden = len(answer.rows) - len(shown)
    table = format_table(answer.columns, shown) if shown else ""
    return table + (f"… {hidden} more\n" if hidden else "") + count_noun(len(answer.rows), "row") + "\n"
