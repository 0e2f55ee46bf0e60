"""usd2kg ask and usd2kg mcp: questions in plain words, from people and from assistants."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.model_options import CompletionsFile
from usd2kg.cli.options import GraphPlace, JsonOutput, SceneName
from usd2kg.cli.output import emit, print_json, talk
from usd2kg.cli.query import answer_text
from usd2kg.errors import Usd2kgError

if TYPE_CHECKING:
    from usd2kg.assistant import InterpretedAnswer
    from usd2kg.query import GraphStore

__all__ = ["ask_command", "mcp_command"]


def ask_command(
    graph: GraphPlace,
    words: Annotated[list[str], typer.Argument(metavar="QUESTION...", help="A question in plain English.")],
    model: Annotated[
        str | None,
        typer.Option(
            "--model",
            help="Let a language model write the query: google:NAME, anthropic:NAME, openai:NAME, openai:NAME@URL or "
            "gguf:FILE; default: the ready questions, offline.",
        ),
    ] = None,
    completions: CompletionsFile = None,
    scene: SceneName = None,
    json: JsonOutput = False,
) -> None:
    """Ask a graph in plain English: 'what is on the table?', 'how many cups are there?'."""
    from usd2kg.assistant import ask_offline  # noqa: PLC0415
    from usd2kg.stores import open_graph  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    store, text = open_graph(graph, scene), " ".join(words)
    asked = ask_offline(store, text) if model is None else _ask_model(store, text, model, completions)
    talk(f"understood as: {asked.understood}")
    if model is not None:
        talk(asked.answer.sparql.strip())
    if json:
        rows = [dict(zip(asked.answer.columns, row, strict=True)) for row in asked.answer.values]
        print_json({**asked.as_json(), "sparql": asked.answer.sparql, "rows": rows})
        return
    emit(asked.summary() + answer_text(asked.answer), None)


def _ask_model(graph: "GraphStore", text: str, model: str, completions: Path | None) -> "InterpretedAnswer":
    from usd2kg.assistant import ask_model  # noqa: PLC0415
    from usd2kg.endpoint import BoundedQueries  # noqa: PLC0415
    from usd2kg.grounding.llm.settings import LLMSettings, open_asker  # noqa: PLC0415

    with open_asker(LLMSettings(model, completions=completions)) as asker, BoundedQueries(graph) as run:
        return ask_model(graph, text, asker.complete, run)


def mcp_command(
    graph: GraphPlace,
    stage: Annotated[
        Path | None, typer.Option("--stage", help="The stage that the graph was built from: gives pictures of things.")
    ] = None,
    scene: SceneName = None,
) -> None:
    """Offer a graph to an assistant, as tools over the Model Context Protocol on stdin and stdout."""
    try:
        from usd2kg.assistant.server import make_server  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise Usd2kgError("mcp: the protocol's SDK is not installed; run: pip install 'usd2kg[mcp]'") from error
    from usd2kg.endpoint import BoundedQueries  # noqa: PLC0415
    from usd2kg.stores import open_graph  # noqa: PLC0415

    store = open_graph(graph, scene)
    picture = None if stage is None else _picture_of(store, stage)
    with BoundedQueries(store) as run:
        make_server(store, run=run, picture=picture).run("stdio")


def _picture_of(graph: "GraphStore", stage: Path) -> Callable[[str], bytes]:
    """Return what draws a thing of the graph where it stands; the first, where several are called so."""
    from usd2kg.render import Renderer  # noqa: PLC0415

    renderer = Renderer(stage)

    def draw(thing: str) -> bytes:
        answer = graph.where_is(thing)
        path = answer.rows[0][answer.columns.index("path")]
        return renderer.render_object(path or "", size=(512, 384), in_context=True)

    return draw
