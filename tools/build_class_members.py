"""Build the data file of what belongs to classes, of public ontologies and of the built-in TBox of places."""

from tools.data_files import csv_bytes, read_source_rows
from usd2kg.ontology.prefixes import expand_curie

COLUMNS = ("class", "ontologies", "things", "not_things")


def build_class_members() -> bytes:
    """Return the CSV file: the lists for public ontologies, and those of the built-in TBox of places."""
    rows = read_source_rows("class_members.csv")
    places = [
        {"class": expand_curie(row["class"]), "ontologies": "places", "things": row["things"], "not_things": ""}
        for row in read_source_rows("place_classes.csv")
        if row["things"]
    ]
    return csv_bytes(COLUMNS, [[row[column] for column in COLUMNS] for row in (*rows, *places)])
