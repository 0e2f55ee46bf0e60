"""Build the data file of nouns for things in `knowledge/place_classes.csv`, and whether homes have such things."""

from tools.data_files import csv_bytes, read_source_rows

__all__ = ["build_place_nouns"]


def build_place_nouns() -> bytes:
    """Return the CSV file `noun,in_homes`, sorted."""
    nouns = {
        noun: row["in_homes"]
        for row in read_source_rows("place_classes.csv")
        for noun in filter(None, [row["label"], *row["synonyms"].split("|"), *row["things"].split("|")])
    }
    return csv_bytes(("noun", "in_homes"), sorted(nouns.items()))
