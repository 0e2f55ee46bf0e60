"""usd2kg query: answers from a graph."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.options.stores import OptionalGraphSource, SceneName
from usd2kg.cli.output import count_noun, emit, notify, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.errors import GraphError
from usd2kg.tracing import span

if TYPE_CHECKING:
    from collections.abc import Callable

    from usd2kg.query import Answer, GraphStore

__all__ = ["answer_text", "ask_scenes", "query_command", "read_sparql"]


def query_command(
    graph: OptionalGraphSource = None,
    words: Annotated[
        list[str] | None,
        Argument(
            metavar="[QUESTION]...",
            help="on X, in X, near X, above X, parts of X, where is X, or all of KIND, a class or a noun.",
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
    explain: Annotated[
        bool, Option("--explain", help="Print the SPARQL query behind the question, to edit and run with --sparql.")
    ] = False,
    json: JsonOutput = False,
) -> None:
    """Query a graph by a question in words, a predefined question, or SPARQL."""
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.query.dataset import with_prefixes  # noqa: PLC0415
    from usd2kg.stores import is_store, open_store, select_graphs  # noqa: PLC0415

    if is_list:
        _print_questions(json)
        return
    if graph is None or (sparql is not None) + (question is not None) + bool(words) != 1:
        raise GraphError(
            "query: expected a graph and either a question, like 'on table', --question with an ID of --list, "
            "or --sparql with a query"
        )
    if given and question is None:
        raise GraphError("query: --with sets a parameter of --question; expected --question ID with it")
    with show_steps("parse", "answer", is_wanted=not json):
        if sparql is not None and is_store(graph):
            # A server evaluates the query itself; its graphs may exceed the memory here.
            store = open_store(graph)
            with span("answer"):
                answer = store.query(read_sparql(sparql), select_graphs(store, scene))
        elif sparql is not None:
            answer = _run_sparql(graph, scene, read_sparql(sparql))
        elif question is not None:
            values = dict(map(_parse_parameter, given or []))
            answer = ask_scenes(graph, scene, lambda store: store.answer(question, values))
        else:
            answer = ask_scenes(graph, scene, lambda store: store.ask(words or []))
    if explain:
        emit(f"{with_prefixes(answer.sparql)}\n")
    elif json:
        print_json(answer.as_dicts())
    else:
        emit(answer_text(answer))


def _run_sparql(place: str, scene: str | None, query: str) -> "Answer":
    from usd2kg.stores import view_scenes  # noqa: PLC0415

    (graph,) = view_scenes(place, scene).values()
    with span("answer"):
        answer = graph.sparql(query)
    if not answer.rows:
        for hint in graph.hints(query):
            notify(f"note: {hint}")
    return answer


def ask_scenes(place: str, scene: str | None, ask: "Callable[[GraphStore], Answer]") -> "Answer":
    """Return the answers about all scenes of a store, with a first column `scene`; or the answer about one graph.

    Scenes without the object or class of the question add no rows.

    Raises:
        GraphError: the question is invalid, or no scene has its object or class.
    """
    from usd2kg.query.answer import join_scenes  # noqa: PLC0415
    from usd2kg.stores import view_scenes  # noqa: PLC0415

    answers: dict[str, Answer] = {}
    problems: list[GraphError] = []
    graphs = view_scenes(place, scene)
    with span("answer"):
        for name, graph in graphs.items():
            try:
                answers[name] = ask(graph)
            except GraphError as error:
                problems.append(error)
    if not answers:
        raise problems[0]
    return next(iter(answers.values())) if len(graphs) == 1 else join_scenes(answers)


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
        GraphError: the file cannot be read, or is named without the @.
    """
    if not text.startswith("@"):
        if len(text.split()) == 1 and Path(text).is_file():
            raise GraphError(f"--sparql {text}: is a file; expected a query, or @{text} to read it from there")
        return text
    try:
        return Path(text[1:]).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GraphError(f"{text[1:]}: cannot be read as a query ({error})") from error


def answer_text(answer: "Answer", limit: int | None = None) -> str:
    """Return an answer as a table of at most `limit` rows, and a last line that counts all rows."""
    shown = answer.rows[:limit]
    hidden = len(answer.rows) - len(shown)
    table = format_table(answer.columns, shown) if shown else ""
    return table + (f"… {hidden} more\n" if hidden else "") + count_noun(len(answer.rows), "row") + "\n"
