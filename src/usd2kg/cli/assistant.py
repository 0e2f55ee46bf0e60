"""usd2kg ask and usd2kg mcp: questions in plain English, from people and from AI assistants."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Argument, Option

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.options.model import CompletionCacheFile, ModelName
from usd2kg.cli.options.queries import QueryTimeLimit
from usd2kg.cli.options.stores import GraphSource, SceneName
from usd2kg.cli.output import emit, notify, print_json
from usd2kg.cli.query import answer_text
from usd2kg.errors import GraphError, Usd2kgError
from usd2kg.tracing import span

if TYPE_CHECKING:
    from usd2kg.assistant import InterpretedAnswer
    from usd2kg.query import GraphStore

__all__ = ["ask_command", "mcp_command"]

_PICTURE_SIZE = (512, 384)
"""Width and height in pixels of the pictures for an assistant."""


def ask_command(
    graph: GraphSource,
    words: Annotated[list[str], Argument(metavar="QUESTION...", help="Question in plain English.")],
    model: ModelName = None,
    completions: CompletionCacheFile = None,
    scene: SceneName = None,
    since: Annotated[
        Path | None,
        Option("--since", metavar="OLD", help="Older version, a graph or a stage, for questions like 'what changed?'."),
    ] = None,
    json: JsonOutput = False,
) -> None:
    """Answer a question in plain English: 'what is on the table?', 'how heavy is the fridge?'."""
    text = " ".join(words)
    if model is None:
        _ask_scenes(graph, scene, text, since, json)
        return
    if since is not None:
        raise GraphError("ask: --since cannot be combined with --model; leave one of them out")
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.stores import open_graph  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    with show_steps("parse", "answer", is_wanted=not json):
        store = open_graph(graph, scene)
        with span("answer"):
            asked = _ask_model(store, text, model, completions)
    notify(f"understood as: {asked.understood}")
    notify(asked.answer.sparql.strip())
    if json:
        print_json(_as_json(asked))
    else:
        emit(asked.summary() + answer_text(asked.answer))


def _ask_scenes(place: str, scene: str | None, text: str, since: Path | None, is_json: bool) -> None:
    """Print the answer about each scene of a store, or about one graph; scenes without an answer are left out."""
    from usd2kg.assistant import ask_offline  # noqa: PLC0415
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.stores import view_scenes  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    answers: dict[str, InterpretedAnswer] = {}
    problems: list[GraphError] = []
    with show_steps("parse", "answer", is_wanted=not is_json):
        graphs = view_scenes(place, scene)
        with span("answer"):
            for name, graph in graphs.items():
                try:
                    answers[name] = ask_offline(graph, text, since)
                except GraphError as error:
                    problems.append(error)
    if not answers:
        raise problems[0]
    first = next(iter(answers.values()))
    notify(f"understood as: {first.understood}")
    if is_json:
        print_json(_as_json(first) if len(graphs) == 1 else {name: _as_json(one) for name, one in answers.items()})
        return
    for name, asked in answers.items():
        heading = "" if len(graphs) == 1 else f"{name}: "
        emit(heading + asked.summary() + (answer_text(asked.answer) if asked.answer.rows or not asked.sentence else ""))


def _as_json(asked: "InterpretedAnswer") -> dict[str, Any]:
    return {**asked.as_json(), "sparql": asked.answer.sparql, "rows": asked.answer.as_dicts()}


def _ask_model(graph: "GraphStore", text: str, model: str, completions: Path | None) -> "InterpretedAnswer":
    from usd2kg.assistant import ask_model  # noqa: PLC0415
    from usd2kg.endpoint import BoundedQueries  # noqa: PLC0415
    from usd2kg.grounding.llm.factory import LLMSettings, open_metered_client  # noqa: PLC0415

    with open_metered_client(LLMSettings(model, completions=completions)) as asker, BoundedQueries(graph) as run:
        return ask_model(graph, text, asker.complete, run)


def mcp_command(
    graph: GraphSource,
    stage: Annotated[
        Path | None, Option("--stage", help="Stage of the graph, to render pictures of objects; default: no pictures.")
    ] = None,
    scene: SceneName = None,
    time_limit: QueryTimeLimit = 10.0,
) -> None:
    """Serve a graph to an AI assistant as tools of the Model Context Protocol, on stdin and stdout."""
    try:
        from usd2kg.assistant.server import make_server  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise Usd2kgError("mcp: the MCP SDK is not installed; run: pip install 'usd2kg[mcp]'") from error
    from usd2kg.endpoint import BoundedQueries, EndpointLimits  # noqa: PLC0415
    from usd2kg.stores import open_graph  # noqa: PLC0415

    store = open_graph(graph, scene)
    picture = None if stage is None else _object_renderer(store, stage)
    with BoundedQueries(store, EndpointLimits(time_limit, workers=1)) as run:
        make_server(store, run=run, picture=picture).run("stdio")


def _object_renderer(graph: "GraphStore", stage: Path) -> Callable[[str], bytes]:
    """Return a function that renders the first object with a given name in context, as a PNG."""
    from usd2kg.render import Renderer  # noqa: PLC0415

    renderer = Renderer(stage)

    def render(name: str) -> bytes:
        answer = graph.where_is(name)
        path = answer.rows[0][answer.columns.index("path")]
        return renderer.render_object(path or "", size=_PICTURE_SIZE, in_context=True)

    return render
