"""Generated pages of the documentation: write one, or check it with --check."""

import sys
from pathlib import Path

from tools.data_files import ROOT

DOCS = ROOT / "docs"


def write_or_check(path: Path, text: str, module: str) -> None:
    """Write a page; with --check on the command line, exit with an error if the file differs.

    Args:
        path: the page.
        text: what it should be.
        module: the module that writes it, for the error.
    """
    if "--check" not in sys.argv[1:]:
        path.write_text(text, "utf-8")
    elif path.read_text("utf-8") != text:
        raise SystemExit(f"{path.relative_to(ROOT)} is out of date; run python -m {module}")
