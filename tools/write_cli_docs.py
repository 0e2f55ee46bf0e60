"""Write docs/cli.md from the commands' own help texts.

Usage: python tools/write_cli_docs.py [--check]
"""

import sys
from pathlib import Path

from typer.testing import CliRunner

from usd2kg.cli.app import app

OUTPUT = Path(__file__).parent.parent / "docs/cli.md"
COMMANDS = (
    (),
    ("build",),
    ("inspect",),
    ("ground",),
    ("query",),
    ("validate",),
    ("label",),
    ("label", "write"),
    ("label", "lint"),
    ("graph",),
    ("graph", "draw"),
    ("render",),
    ("serve",),
    ("store",),
    ("store", "load"),
    ("store", "list"),
    ("store", "remove"),
    ("store", "update"),
    ("ontology",),
    ("ontology", "show"),
    ("ontology", "linearize"),
    ("ontology", "scope"),
    ("ontology", "vocabulary"),
    ("ontology", "shapes"),
    ("eval",),
    ("eval", "run"),
    ("eval", "reproduce"),
    ("eval", "compare"),
    ("eval", "annotate"),
    ("eval", "agreement"),
    ("eval", "kitchen-set"),
    ("demo",),
)
INTRODUCTION = """\
# Command line

Written by `tools/write_cli_docs.py` from the help texts. Data goes to stdout, talk and progress to stderr.

| exit code | meaning |
| --- | --- |
| 0 | done |
| 2 | wrong usage, or an input or output that cannot be used; one line on stderr says which and what to do |
"""


def page() -> str:
    """Return the page."""
    sections = [INTRODUCTION]
    for command in COMMANDS:
        result = CliRunner().invoke(app, [*command, "--help"], prog_name="usd2kg", env={"COLUMNS": "100"})
        if result.exit_code:
            raise SystemExit(f"{command}: {result.output}")
        sections.append(f"## usd2kg {' '.join(command)}".rstrip() + f"\n\n```text\n{result.output.strip()}\n```\n")
    return "\n".join(sections)


def main() -> None:
    """Write the page, or check that it is what would be written."""
    if "--check" in sys.argv:
        if OUTPUT.read_text("utf-8") != page():
            raise SystemExit(f"{OUTPUT} is not what the help texts say; run python tools/write_cli_docs.py")
        return
    OUTPUT.write_text(page(), "utf-8")


if __name__ == "__main__":
    main()
