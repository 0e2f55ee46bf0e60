"""usd2kg licences: origin and licence of the data in the package."""

from importlib.resources import files

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.output import emit, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.knowledge import read_rows

__all__ = ["licences_command"]

_COLUMNS = ("file", "licence", "origin", "description")
_PAGE = "endpoint/app/licenses.md"


def licences_command(json: JsonOutput = False) -> None:
    """List the origin and licence of all data in the package; its code is under Apache-2.0."""
    rows = read_rows("licences.csv")
    if json:
        print_json(rows)
        return
    emit(format_table(_COLUMNS, [[row[column] for column in _COLUMNS] for row in rows]))
    if files("usd2kg").joinpath(_PAGE).is_file():
        emit(f"\nThe pages of the studio and of serve contain libraries, whose licences are in {_PAGE}.\n")
