"""Arguments and options of commands that read a scene or an ontology, or print JSON."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from usd2kg.cli.limits import FINDINGS_PER_RULE

__all__ = [
    "BUILT_IN_ONTOLOGIES",
    "AllFindings",
    "BaseIri",
    "JsonOutput",
    "OntologyFile",
    "ReportFolder",
    "SceneFile",
    "TextFile",
]

BUILT_IN_ONTOLOGIES = ("home", "places")
"""Values of --ontology that are not files."""

SceneFile = Annotated[Path, Argument(metavar="SCENE", help="USD stage, or a file or folder that usd2kg convert reads.")]
OntologyFile = Annotated[
    Path | None,
    Option(
        "--ontology",
        metavar="|".join(("FILE", *BUILT_IN_ONTOLOGIES)),
        help="OWL file with the candidate classes, or a built-in ontology; default: the one that suits the scene or "
        "graph; home for eval.",
    ),
]
BaseIri = Annotated[
    str | None,
    Option("--base", help="Namespace of the individuals, ending in / or #; default: derived from the file name."),
]
JsonOutput = Annotated[bool, Option("--json", help="Print JSON instead of text.")]
TextFile = Annotated[
    Path | None,
    Option(
        "--output",
        "-o",
        help="File to write; default, or -: stdout.",
        callback=lambda path: None if path == Path("-") else path,
    ),
]
ReportFolder = Annotated[Path, Option("--output", "-o", help="Folder for answers and reports.")]
AllFindings = Annotated[
    bool, Option("--all", help=f"Show every finding; default: the first {FINDINGS_PER_RULE} of each rule.")
]
