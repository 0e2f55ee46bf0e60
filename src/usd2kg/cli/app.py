"""The command `usd2kg`.

Exit codes: 0 success; 1 `validate`, `label lint` or `ontology check` has findings, `diff` has differences, `doctor`
misses a package, or `batch` could not build a scene; 2 wrong usage, or an input or output cannot be used; 130 `ground`
or `batch` was interrupted and keeps the finished results.
"""

import io
import logging
import sys
import traceback
from collections.abc import Iterable, Sequence
from importlib import import_module
from typing import Annotated

import typer
from typer import Option

from usd2kg.cli.log_format import set_up_logging
from usd2kg.cli.output import emit, notify, to_single_line
from usd2kg.cli.project_file import read_project_options
from usd2kg.cli.terminal import forbid_colors
from usd2kg.errors import Usd2kgError
from usd2kg.garbage import collect_rarely
from usd2kg.tracing import set_up_tracing
from usd2kg.version import VERSION

__all__ = ["main", "make_app"]

_EXHAUSTED = {
    MemoryError: "not enough memory for this input; try a part of it (--include, --objects)",
    RecursionError: "the input is nested too deeply to be read; flatten it (--verbose shows where)",
}
"""Exception → message, so that the user gets one line for any input."""

_COMMANDS = {
    "build": "build",
    "batch": "batch",
    "inspect": "inspect",
    "convert": "convert",
    "ground": "ground",
    "query": "query",
    "ask": "assistant",
    "validate": "validate",
    "diff": "diff",
    "render": "render",
    "mcp": "assistant",
    "demo": "demo",
    "doctor": "doctor",
    "licences": "licences",
    "init": "init",
    "serve": "serve",
    "studio": "studio",
}
"""Command → module of `usd2kg.cli` with its function, `build_command` for build; in the order of the help."""
_GROUPS = {
    "graph": "graph",
    "label": "label",
    "store": "store",
    "ontology": "ontology",
    "eval": "evaluate",
    "completions": "completions",
}
"""Group of commands → module with its `app`."""


def make_app(arguments: Iterable[str] = ()) -> typer.Typer:
    """Return the command line for a call: with the command or group that it names, else with all.

    Most commands run in less time than it takes to import the others.

    Args:
        arguments: the arguments of the call, without global options.
    """
    app = typer.Typer(
        name="usd2kg",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings={"help_option_names": ["-h", "--help"]},
        help="Turn an OpenUSD scene into a knowledge graph: ground every object to a class of an OWL ontology.",
    )
    app.callback()(_options)
    first = next(iter(arguments), None)
    names = {first} if first in _COMMANDS or first in _GROUPS else {*_COMMANDS, *_GROUPS}
    for name in [name for name in _COMMANDS if name in names]:
        app.command(name)(getattr(import_module(f"usd2kg.cli.{_COMMANDS[name]}"), f"{name}_command"))
    for name in [name for name in _GROUPS if name in names]:
        app.add_typer(import_module(f"usd2kg.cli.{_GROUPS[name]}").app, name=name)
    return app


def _print_version(is_wanted: bool) -> None:
    if is_wanted:
        emit(f"usd2kg {VERSION}\n")
        raise typer.Exit


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
    collect_rarely()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            # Escape characters that the terminal's encoding lacks instead of failing.
            stream.reconfigure(errors="backslashreplace")
    global_options, arguments = _split_global_options(sys.argv[1:])
    try:
        _set_up_output(global_options)
        if "--no-project-file" not in global_options:
            global_options, arguments = _with_project_options(global_options, arguments)
        make_app(arguments)(args=[*global_options, *arguments], prog_name="usd2kg")
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
    found = read_project_options(make_app, arguments, global_options)
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
