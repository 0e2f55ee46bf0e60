"""The command line of the scripts that write a scene."""

import argparse
from collections.abc import Callable
from pathlib import Path

__all__ = ["run_command"]


def run_command(doc: str, stage: Path, build: Callable[[Path], int]) -> None:
    """Write a stage and print the number of its objects.

    Args:
        doc: the docstring of the script, whose first line describes it.
        stage: where the stage is written by default.
        build: writes it, and returns the number of its objects.
    """
    parser = argparse.ArgumentParser(description=doc.split("\n", maxsplit=1)[0])
    parser.add_argument("-o", dest="out", type=Path, default=stage, help="stage to write (default: %(default)s)")
    out = parser.parse_args().out
    print(f"{out}: {build(out)} objects")
