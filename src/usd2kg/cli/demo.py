"""usd2kg demo: the built-in scene as a knowledge graph, offline."""

import time
from pathlib import Path
from typing import Annotated

from typer import Option

from usd2kg.cli.build_summary import summarize_build, summary_text
from usd2kg.cli.limits import DEMO_ROWS
from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.output import emit, print_json
from usd2kg.cli.query import answer_text

__all__ = ["demo_command"]

_QUESTIONS = ("on dining table", "in refrigerator", "all of appliance")


def demo_command(
    output: Annotated[Path, Option("--output", "-o", help="Graph to write.")] = Path("kitchen.ttl"),
    json: JsonOutput = False,
) -> None:
    """Build the knowledge graph of the built-in demo kitchen and ask it three questions."""
    from usd2kg.demo import demo_scene  # noqa: PLC0415
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.graph import rdf_format, write_graph  # noqa: PLC0415
    from usd2kg.pipeline import build  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.query import load_graph  # noqa: PLC0415

    start = time.perf_counter()
    # The questions are answered from the file, so it has to be a format that can be read.
    rdf_format(output)
    check_writable(output)
    result = build(demo_scene(), progress=True)
    write_graph(result.graph, output)
    summary = summarize_build(result, str(output), time.perf_counter() - start)
    summary["scene"] = demo_scene().name
    store = load_graph(output)
    answers = {question: store.ask(question.split()) for question in _QUESTIONS}
    if json:
        print_json({**summary, "answers": {question: answer.as_dicts() for question, answer in answers.items()}})
        return
    emit(summary_text(summary) + "\n")
    for question, answer in answers.items():
        emit(f"\n$ usd2kg query {output} {question}\n{answer_text(answer, DEMO_ROWS)}")
