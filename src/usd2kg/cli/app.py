"""The command `usd2kg`.

Exit codes: 0 success; 1 `validate`, `label lint` or `ontology check` has findings, `diff` has differences, `doctor`
misses a package, or `batch` could not build a scene; 2 wrong usage, or an input or output cannot be used; 130 `ground`
or `batch` was interrupted and keeps the finished results.
"""

import io
import logging
import sys
import traceback
from collections.abc import Sequence
from typing import Annotated

import typer
from typer import Option

from usd2kg.cli import (
    assistant,
    batch,
    build,
    completions,
    convert,
    demo,
    diff,
    doctor,
    evaluate,
    graph,
    ground,
    init,
    inspect,
    label,
    licences,
    ontology,
    query,
    render,
    serve,
    store,
    studio,
    validate,
)
from usd2kg.cli.log_format import set_up_logging
from usd2kg.cli.output import emit, notify, to_single_line
from usd2kg.cli.project_file import read_project_options
from usd2kg.cli.terminal import forbid_colors
from usd2kg.errors import Usd2kgError
from usd2kg.tracing import set_up_tracing

__all__ = ["app", "main"]

_EXHAUSTED = {
    MemoryError: "not enough memory for this input; try a part of it (--include, --objects)",
    RecursionError: "the input is nested too deeply to be read; flatten it (--verbose shows where)",
}
"""Exception → message, so that the user gets one line for any input."""

app = typer.Typer(
    name="usd2kg",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Turn an OpenUSD scene into a knowledge graph: ground every object to a class of an OWL ontology.",
)
app.command("build")(build.build_command)
app.command("batch")(batch.batch_command)
app.command("inspect")(inspect.inspect_command)
app.command("convert")(convert.convert_command)
app.command("ground")(ground.ground_command)
app.command("query")(query.query_command)
app.command("ask")(assistant.ask_command)
app.command("validate")(validate.validate_command)
app.command("diff")(diff.diff_command)
app.command("render")(render.render_command)
app.command("mcp")(assistant.mcp_command)
app.command("demo")(demo.demo_command)
app.command("doctor")(doctor.doctor_command)
app.command("licences")(licences.licences_command)
app.command("init")(init.make_init_command(app))
app.add_typer(graph.app, name="graph")
app.add_typer(label.app, name="label")
app.command("serve")(serve.serve_command)
app.command("studio")(studio.studio_command)
app.add_typer(store.app, name="store")
app.add_typer(ontology.app, name="ontology")
app.add_typer(evaluate.app, name="eval")
app.add_typer(completions.app, name="completions")


def _print_version(is_wanted: bool) -> None:
    if is_wanted:
        from importlib.metadata import version  # noqa: PLC0415

        emit(f"usd2kg {version('usd2kg')}\n")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, Option("--version", help="Print the version and exit.", is_eager=True, callback=_print_version)
    ] = False,
    verbose: Annotated[
        bool, Option("--verbose", help="Log each step, and show the traceback of an error. Accepted anywhere.")
    ] = False,
    no_project_file: Annotated[
        bool, Option("--no-project-file", help="Ignore the options of usd2kg.toml. Accepted anywhere.")
    ] = False,
    no_color: Annotated[
        bool, Option("--no-color", help="Print no colours, as with the variable NO_COLOR. Accepted anywhere.")
    ] = False,
    log_format: Annotated[
        str,
        Option(
            "--log-format",
            metavar="text|json",
            help="Format of the messages on stderr: text, or json, one object per line with the time of each step. "
            "Accepted anywhere.",
        ),
    ] = "text",
) -> None:
    level = logging.INFO if verbose or log_format == "json" else logging.WARNING
    set_up_logging(level, log_format)
    set_up_tracing()
    if no_color:
        forbid_colors()


def main() -> None:
    """Run the command line; a `Usd2kgError`, or running out of memory or stack, becomes one line and exit code 2."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # Escape characters that the terminal's encoding lacks instead of failing.
            stream.reconfigure(errors="backslashreplace")
    global_options, arguments = _split_global_options(sys.argv[1:])
    try:
        _set_up_output(global_options)
        if "--no-project-file" not in global_options:
            global_options, arguments = _with_project_options(global_options, arguments)
        app(args=[*global_options, *arguments], prog_name="usd2kg")
    except Usd2kgError as error:
        if "--verbose" in global_options:
            traceback.print_exc()
        notify(f"usd2kg: {to_single_line(str(error))}", logging.ERROR)
        sys.exit(2)
    except (MemoryError, RecursionError) as error:
        if "--verbose" in global_options:
            traceback.print_exc()
        notify(
            f"usd2kg: {_EXHAUSTED[MemoryError if isinstance(error, MemoryError) else RecursionError]}", logging.ERROR
        )
        sys.exit(2)


def _split_global_options(arguments: Sequence[str]) -> tuple[list[str], list[str]]:
    """Return the global options and the other arguments.

    Click takes a global option only before the command; users append it to the command that failed.
    """
    found: list[str] = []
    others: list[str] = []
    waiting = iter(arguments)
    for argument in waiting:
        if argument in {"--verbose", "--no-project-file", "--no-color"} or argument.startswith("--log-format="):
            found.append(argument)
        elif argument == "--log-format":
            found.append(f"--log-format={next(waiting, '')}")
        else:
            others.append(argument)
    return found, others


def _with_project_options(global_options: list[str], arguments: list[str]) -> tuple[list[str], list[str]]:
    """Return global options and arguments with the options of `usd2kg.toml`, which are announced on stderr."""
    found = read_project_options(app, arguments, global_options)
    if found is None:
        return global_options, arguments
    _set_up_output(found.global_options)
    notify(f"{found.file}: sets {', '.join(found.keys)}")
    return [*found.global_options, *global_options], [*found.arguments]


def _set_up_output(global_options: Sequence[str]) -> None:
    """Choose colours and the message format before the first message."""
    if "--log-format=json" in global_options:
        set_up_logging(logging.INFO, "json")
    if "--no-color" in global_options:
        forbid_colors()
