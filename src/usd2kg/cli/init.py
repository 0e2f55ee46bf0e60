"""usd2kg init: write a file of options for a project."""

import textwrap
from pathlib import Path
from typing import Annotated

import typer
from typer import Argument

from usd2kg.cli.output import notify
from usd2kg.cli.project_file import (
    ALLOWED_ANYWHERE,
    PROJECT_OPTIONS_FILE,
    CommandOption,
    find_global_options,
    walk_options,
)
from usd2kg.errors import OutputError

__all__ = ["init_command"]

_INTRODUCTION = """\
# Options of usd2kg for the scenes in this folder and below. Remove the # before an option to set it.
# A key is the name of an option and applies to every command that has it; a table such as [build] sets one command.
# Relative paths start at this folder. Options on the command line take precedence.
"""
_EXAMPLES = {
    **dict.fromkeys(("alignment", "decisions"), '"{}.sssom.tsv"'),
    **dict.fromkeys(("abstain", "every-prim", "expand-instancers", "no-color", "verbose"), "true"),
    **dict.fromkeys(("dictionary", "class-sizes", "objects"), '"{}.csv"'),
    **dict.fromkeys(("relations", "rules"), '"{}.toml"'),
    "annotations": '"owl"',
    "base": '"https://example.org/scene/"',
    "evidence": '"name,geometry,hierarchy"',
    "exclude": '["/World/Lights/**"]',
    "grounder": '"lexical"',
    "include": '["/World/Props/*"]',
    "kind": '["component"]',
    "log-format": '"json"',
    "metres-per-unit": "0.01",
    "ontology": '"ontology.ttl"',
    "profile": '"auto"',
    "regime": '"semantic"',
    "relation-kinds": '"on,inside"',
    "reviewer": '"https://orcid.org/0000-0000-0000-0000"',
    "time": "0",
    "up-axis": '"Z"',
    "viewpoint": '"0,-3,1.6"',
}
"""Option → an example of its value; {} stands for the name of the option."""
_WIDTH = 100


def init_command(
    folder: Annotated[Path, Argument(help="Folder of the project; default: the current folder.")] = Path(),
) -> None:
    """Write usd2kg.toml, where a project sets options once for all commands."""
    from usd2kg.cli.app import make_app  # noqa: PLC0415 - it imports this module

    file = folder / PROJECT_OPTIONS_FILE
    try:
        with file.open("x", encoding="utf-8") as new:
            new.write(_content(make_app()))
    except FileExistsError:
        raise OutputError(f"{file}: exists already; edit it") from None
    except OSError as error:
        raise OutputError(f"{file}: cannot be written ({error.strerror}); choose another folder") from error
    notify(f"{file}: written; remove the # before the options to set")


def _content(app: typer.Typer) -> str:
    options = {option.key: option for option in find_global_options(app)}
    for _, found in walk_options(app):
        for option in found:
            options.setdefault(option.key, option)
    common = (ALLOWED_ANYWHERE | {"grounder"}) & options.keys()
    return _INTRODUCTION + "".join(_entry(options[key]) for key in sorted(common))


def _entry(option: CommandOption) -> str:
    # The position of an option on the command line is irrelevant here.
    lines = textwrap.wrap(option.help.removesuffix(" Accepted anywhere."), _WIDTH - 2, break_on_hyphens=False)
    example = _EXAMPLES[option.key].format(option.key)
    return "".join(f"\n# {line}" for line in lines) + f"\n# {option.key} = {example}\n"
