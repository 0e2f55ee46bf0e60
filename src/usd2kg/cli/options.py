"""Arguments and options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["Dictionary", "Evidence", "GrounderName", "JsonOutput", "OntologyFile", "Regime", "SceneFile"]

SceneFile = Annotated[Path, typer.Argument(metavar="SCENE", help="A USD stage: .usd, .usda, .usdc or .usdz.")]
OntologyFile = Annotated[
    Path | None,
    typer.Option("--ontology", help="An OWL file whose classes to use; default: the built-in home ontology."),
]
GrounderName = Annotated[
    str,
    typer.Option("--grounder", help="Who chooses the classes: embedded (default), dictionary, embedding or volume."),
]
Dictionary = Annotated[
    Path | None,
    typer.Option("--dictionary", help="For the dictionary grounder: a CSV file name,class; default: Multiverse's."),
]
Regime = Annotated[
    str,
    typer.Option("--regime", help="How names are masked: semantic (default), abbreviated, opaque, opaque-anonymous."),
]
Evidence = Annotated[
    str | None,
    typer.Option(
        "--evidence",
        help="Evidence that may be used, comma-separated: name, geometry, position, hierarchy, asset, materials, "
        "parts; default: all.",
    ),
]
JsonOutput = Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")]
