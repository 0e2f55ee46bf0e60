"""Run the notebooks in examples/ and write their outputs.

Usage: python -m tools.write_notebooks [--check] [NAME...]

Outputs hold nothing that differs between two runs. Pictures are not compared: compression differs between versions of
zlib.
"""

import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient

from tools.data_files import ROOT

__all__ = ["run_notebook"]

EXAMPLES = ROOT / "examples"
_TIMEOUT_S = 300
_METADATA = {
    "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
    "language_info": {"name": "python"},
}
_PICTURE = re.compile(r"data:image/png;base64,[^\"]*")


def run_notebook(path: Path) -> Any:
    """Return a notebook with the outputs of a run in its folder, by a new kernel.

    Raises:
        nbclient.exceptions.CellExecutionError: a cell raises.
    """
    notebook = nbformat.read(path, as_version=4)
    client = NotebookClient(
        notebook,
        timeout=_TIMEOUT_S,
        record_timing=False,
        coalesce_streams=True,
        resources={"metadata": {"path": str(path.parent)}},
    )
    client.execute()
    notebook.metadata = nbformat.from_dict(_METADATA)
    for number, cell in enumerate(notebook.cells, start=1):
        cell.id, cell.metadata = f"cell-{number}", nbformat.from_dict({})
    return notebook


def _check(path: Path, written: Any) -> None:
    """Exit with an error if the outputs of a notebook differ from those of a run."""
    stored = nbformat.read(path, as_version=4)
    for number, (before, after) in enumerate(zip(stored.cells, written.cells, strict=True), start=1):
        if list(_outputs(before)) != list(_outputs(after)):
            raise SystemExit(
                f"{path.relative_to(ROOT)}: the outputs of cell {number} are out of date; run python -m "
                f"tools.write_notebooks {path.stem}\n{list(_outputs(before))}\n{list(_outputs(after))}"
            )


def _outputs(cell: Any) -> Iterator[str]:
    """Yield the outputs of a cell as text, without pictures."""
    for output in cell.get("outputs", ()):
        yield _PICTURE.sub("", json.dumps(output, sort_keys=True, ensure_ascii=False))


def _main(arguments: list[str]) -> None:
    names = [argument for argument in arguments if not argument.startswith("--")]
    for path in [EXAMPLES / f"{name}.ipynb" for name in names] or sorted(EXAMPLES.glob("*.ipynb")):
        notebook = run_notebook(path)
        if "--check" in arguments:
            _check(path, notebook)
        else:
            nbformat.write(notebook, path)


if __name__ == "__main__":
    _main(sys.argv[1:])
