"""usd2kg demo: the main job on the built-in scene, offline."""

import time
from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.build import summarize, summary_text
from usd2kg.cli.options import JsonOutput
from usd2kg.cli.output import emit, print_json
from usd2kg.cli.query import answer_text

__all__ = ["demo_command"]

_SHOWN = 12
_QUESTIONS = ("on dining table", "in refrigerator", "all of appliance")


def demo_command(
    output: Annotated[Path, typer.Option("--output", "-o", help="Graph to write.")] = Path("kitchen.ttl"),
    json: JsonOutput = False,
) -> None:
    """Build the knowledge graph of the built-in demo kitchen and ask it three questions."""
    from usd2kg.demo import demo_scene  # noqa: PLC0415
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.graph import rdf_format, write_graph  # noqa: PLC0415
    from usd2kg.pipeline import build  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.query import load_graph  # noqa: PLC0415

    start = time.perf_counter()
    # Questions are put to the file that was written.
    rdf_format(output)
    check_writable(output)
    result = build(demo_scene())
    write_graph(result.graph, output)
    seconds = time.perf_counter() - start
    summary = {**summarize(result), "scene": demo_scene().name, "output": str(output), "seconds": round(seconds, 3)}
    store = load_graph(output)
    answers = {question: store.ask(question.split()) for question in _QUESTIONS}
    if json:
        rows = {q: [dict(zip(a.columns, row, strict=True)) for row in a.values] for q, a in answers.items()}
        print_json({**summary, "answers": rows})
        return
    emit(summary_text(summary) + "\n", None)
    for question, answer in answers.items():
        emit(f"\n$ usd2kg query {output} {question}\n{answer_text(answer, _SHOWN)}", None)
