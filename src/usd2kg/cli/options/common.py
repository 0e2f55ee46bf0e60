"""Arguments and options of commands that read a scene or an ontology, or print JSON."""

from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.limits import FINDINGS_PER_RULE

__all__ = ["AllFindings", "BaseIri", "JsonOutput", "OntologyFile", "ReportFolder", "SceneFile", "TextFile"]

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="USD stage: .usd, .usda, .usdc or .usdz.")]
OntologyFile = Annotated[
    Path | None,
    typer.Option("--ontology", help="OWL file with the candidate classes; default: the built-in home ontology."),
]
BaseIri = Annotated[
    str | None,
    typer.Option("--base", help="Namespace of the individuals, ending in / or #; default: derived from the file name."),
]
JsonOutput = Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")]
TextFile = Annotated[Path | None, typer.Option("--output", "-o", help="File to write; default: stdout.")]
ReportFolder = Annotated[Path, typer.Option("--output", "-o", help="Folder for answers and reports.")]
AllFindings = Annotated[
    bool, typer.Option("--all", help=f"Show every finding; default: the first {FINDINGS_PER_RULE} of each rule.")
]
