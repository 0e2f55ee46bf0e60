"""Write docs/cli.md from the help texts of all commands.

Usage: python tools/write_cli_docs.py [--check]
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import typer
from typer.testing import CliRunner

from usd2kg.cli.app import app

OUTPUT = Path(__file__).parent.parent / "docs/cli.md"
INTRODUCTION = """\
# Command line

Written by `tools/write_cli_docs.py` from the help texts. Data goes to stdout, messages and progress go to stderr.

| exit code | meaning |
| --- | --- |
| 0 | success |
| 1 | `validate`, `label lint` or `ontology check` has findings, or `diff` has differences |
| 2 | wrong usage, or an input or output cannot be used; one line on stderr states what to do |
| 130 | `ground` was interrupted; the mapping has the objects that were grounded before |
"""


def command_names(command: object, names: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield the names of a command and of all its subcommands, in the order of the help text."""
    yield names
    for name, subcommand in getattr(command, "commands", {}).items():
        yield from command_names(subcommand, (*names, name))


def page() -> str:
    """Return the page."""
    sections = [INTRODUCTION]
    for names in command_names(typer.main.get_command(app)):
        result = CliRunner().invoke(app, [*names, "--help"], prog_name="usd2kg", env={"COLUMNS": "100"})
        if result.exit_code:
            raise SystemExit(f"{' '.join(names)}: {result.output}")
        sections.append(f"## {' '.join(['usd2kg', *names])}\n\n```text\n{result.output.strip()}\n```\n")
    return "\n".join(sections)


def main() -> None:
    """Write the page, or check that it is up to date."""
    if "--check" in sys.argv:
        if OUTPUT.read_text("utf-8") != page():
            raise SystemExit(f"{OUTPUT} differs from the help texts; run python tools/write_cli_docs.py")
        return
    OUTPUT.write_text(page(), "utf-8")


if __name__ == "__main__":
    main()
