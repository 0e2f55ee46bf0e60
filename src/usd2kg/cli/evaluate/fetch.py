"""usd2kg eval fetch: download labelled scenes."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from usd2kg.cli.output import emit, notify
from usd2kg.errors import EvaluationError

__all__ = ["fetch_command"]


def fetch_command(
    manifest: Annotated[
        Path, Argument(metavar="MANIFEST", help="TOML file of scenes with licences, addresses and hashes.")
    ],
    names: Annotated[list[str] | None, Argument(metavar="[NAME...]", help="Scenes to fetch; default: all.")] = None,
    into: Annotated[Path, Option("--into", help="Folder for the scenes.")] = Path("scenes"),
    force: Annotated[bool, Option("--force", help="Overwrite files that differ; default: refuse.")] = False,
) -> None:
    """Download scenes with gold labels, check their hashes, and print the matrix for eval reproduce."""
    from usd2kg.evaluation.fetch import fetch_scenes  # noqa: PLC0415
    from usd2kg.evaluation.manifest import read_manifest  # noqa: PLC0415

    known = {scene.name: scene for scene in read_manifest(manifest)}
    for name in names or ():
        if name not in known:
            raise EvaluationError(f"{manifest}: has no scene {name!r}; expected one of {', '.join(known)}")
    chosen = [known[name] for name in dict.fromkeys(names or known)]
    emit(f"{fetch_scenes(chosen, into, overwrites=force, report=notify)}\n")
