"""Write docs/cli.md from the help texts of all commands.

Usage: python -m tools.write_cli_docs [--check]
"""

from collections.abc import Iterator

import typer
from typer.testing import CliRunner

from tools.generated_docs import DOCS, write_or_check
from usd2kg.cli.app import make_app

INTRODUCTION = """\
# Command line

Written by `tools/write_cli_docs.py` from the help texts. Data goes to stdout, messages and progress go to stderr.
[usd2kg.toml](project_file.md) sets options once for a project.

| exit code | meaning |
| --- | --- |
| 0 | success |
| 1 | `validate`, `label lint` or `ontology check` has findings, `diff` has differences, or `doctor` misses a package |
| 2 | wrong usage, or an input or output cannot be used; one line on stderr states what to do |
| 130 | `ground` was interrupted; the mapping has the objects that were grounded before |
"""


def walk_commands(command: object, names: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Yield the names of a command and of all its subcommands, in the order of the help text."""
    yield names
    for name, subcommand in getattr(command, "commands", {}).items():
        yield from walk_commands(subcommand, (*names, name))


def build_page() -> str:
    """Return the page."""
    sections = [INTRODUCTION]
    for names in walk_commands(typer.main.get_command(make_app())):
        result = CliRunner().invoke(make_app(), [*names, "--help"], prog_name="usd2kg", env={"COLUMNS": "100"})
        if result.exit_code:
            raise SystemExit(f"{' '.join(names)}: {result.output}")
        sections.append(f"## {' '.join(['usd2kg', *names])}\n\n```text\n{result.output.strip()}\n```\n")
    return "\n".join(sections)


if __name__ == "__main__":
    write_or_check(DOCS / "cli.md", build_page(), "tools.write_cli_docs")
