"""Build the data file of the names in `knowledge/home_names.csv`, one row per class: 20,000 rows take long to read."""

from tools.data_files import csv_bytes, read_source_rows

__all__ = ["build_home_names"]


def build_home_names() -> bytes:
    """Return the CSV file `class,names`, names separated by `|`, in the order of the source."""
    names: dict[str, list[str]] = {}
    for row in read_source_rows("home_names.csv"):
        names.setdefault(row["class"], []).append(row["name"])
    return csv_bytes(("class", "names"), [(name, "|".join(found)) for name, found in names.items()])
