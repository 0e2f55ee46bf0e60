"""The command `usd2kg`.

Exit codes: 0 done, 1 `validate`, `label lint` or `ontology check` has findings or `diff` finds differences, 2 wrong
usage or an input or output that cannot be used.
"""

import io
import logging
import sys
import traceback
from typing import Annotated

import typer

from usd2kg.cli import (
    assistant,
    build,
    completions,
    demo,
    diff,
    evaluate,
    graph,
    ground,
    inspect,
    label,
    ontology,
    query,
    render,
    serve,
    store,
    validate,
)
from usd2kg.cli.output import emit, talk
from usd2kg.errors import Usd2kgError

__all__ = ["app", "main"]

app = typer.Typer(
    name="usd2kg",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="From an OpenUSD scene to a knowledge graph: grounds every object to a class of your OWL ontology.",
)
app.command("build")(build.build_command)
app.command("inspect")(inspect.inspect_command)
app.command("ground")(ground.ground_command)
app.command("query")(query.query_command)
app.command("ask")(assistant.ask_command)
app.command("validate")(validate.validate_command)
app.command("diff")(diff.diff_command)
app.command("render")(render.render_command)
app.command("mcp")(assistant.mcp_command)
app.command("demo")(demo.demo_command)
app.add_typer(graph.app, name="graph")
app.add_typer(label.app, name="label")
app.command("serve")(serve.serve_command)
app.add_typer(store.app, name="store")
app.add_typer(ontology.app, name="ontology")
app.add_typer(evaluate.app, name="eval")
app.add_typer(completions.app, name="completions")


def _print_version(is_wanted: bool) -> None:
    if is_wanted:
        from importlib.metadata import version  # noqa: PLC0415

        emit(f"usd2kg {version('usd2kg')}\n", None)
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and stop.", is_eager=True, callback=_print_version)
    ] = False,
    verbose: Annotated[
        bool,
        typer.Option("--verbose", help="Say what is done, and show the traceback of an error; may stand anywhere."),
    ] = False,
) -> None:
    level = logging.INFO if verbose else logging.WARNING
    logging.basicConfig(level=level, stream=sys.stderr, format="%(message)s")


def main() -> None:
    """Run the command line; an error that a user can mend becomes one line and exit code 2."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # A terminal that cannot show a name shows its code instead, and the run goes on.
            stream.reconfigure(errors="backslashreplace")
    arguments = sys.argv[1:]
    is_verbose = "--verbose" in arguments
    if is_verbose:
        # It belongs to the whole program, but people add it to the end of the command that just failed.
        arguments = ["--verbose", *(argument for argument in arguments if argument != "--verbose")]
    try:
        app(args=arguments, prog_name="usd2kg")
    except Usd2kgError as error:
        if is_verbose:
            traceback.print_exc()
        talk(f"usd2kg: {' '.join(str(error).split())}")
        sys.exit(2)
