"""Write the tables beside a scene: gold labels and relations."""

import csv
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

GOLD_HEADER = ("path", "class", "also")


def read_labels(path: Path) -> dict[str, tuple[str, str]]:
    """Return asset → class and accepted further classes, separated by `|`."""
    with path.open(encoding="utf-8") as file:
        return {row["asset"]: (row["class"], row["also"]) for row in csv.DictReader(file)}


def write_gold(path: Path, labels: Mapping[str, tuple[str, str]]) -> None:
    """Write the label of each prim path, sorted by path."""
    write_table(path, GOLD_HEADER, sorted((prim_path, *label) for prim_path, label in labels.items()))


def write_table(path: Path, header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Write a CSV file."""
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
