"""usd2kg ground: the mapping of prims to classes, without a graph."""

from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.options import (
    AbbreviatedLength,
    Abstains,
    ClassSizes,
    Dictionary,
    EveryPrim,
    Evidence,
    Exclude,
    ExpandInstancers,
    GrounderName,
    Include,
    Kinds,
    MetresPerUnit,
    ObjectList,
    OntologyFile,
    Regime,
    SceneFile,
    TimeCode,
    UpAxis,
    read_options,
)
from usd2kg.cli.output import emit, talk

__all__ = ["ground_command"]


def ground_command(
    scene: SceneFile,
    ontology: OntologyFile = None,
    grounder: GrounderName = "embedded",
    dictionary: Dictionary = None,
    abstain: Abstains = False,
    class_sizes: ClassSizes = None,
    regime: Regime = "semantic",
    abbreviated_length: AbbreviatedLength = 4,
    evidence: Evidence = None,
    paths: Annotated[
        Path | None, typer.Option("--paths", help="Answer only for the prims in the column 'path' of this CSV file.")
    ] = None,
    metres_per_unit: MetresPerUnit = None,
    up_axis: UpAxis = None,
    time_code: TimeCode = None,
    expand_instancers: ExpandInstancers = False,
    include: Include = None,
    exclude: Exclude = None,
    kind: Kinds = None,
    objects: ObjectList = None,
    every_prim: EveryPrim = False,
    file_format: Annotated[str, typer.Option("--format", help="csv (default) or json.")] = "csv",
    output: Annotated[Path | None, typer.Option("--output", "-o", help="File to write; default: stdout.")] = None,
) -> None:
    """Ground the objects of a scene: print path, class, label, confidence, status and grounder of each."""
    from usd2kg import grounding  # noqa: PLC0415
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    groups = grounding.parse_evidence(evidence) if evidence is not None else None
    naming_regime = grounding.parse_regime(regime)
    grounding.check_format(file_format)
    if output is not None:
        check_writable(output)
    chosen = grounding.make_grounder(grounder, dictionary=dictionary, class_sizes=class_sizes, abstains=abstain)
    wanted = grounding.read_paths(paths) if paths is not None else None
    tbox = open_tbox(ontology)
    options = read_options(
        metres_per_unit, up_axis, time_code, expand_instancers, include, exclude, kind, objects, every_prim
    )
    found = read_scene(scene, paths=wanted, options=options)
    result = grounding.ground(
        found,
        tbox,
        chosen,
        regime=naming_regime,
        evidence=groups,
        paths=wanted,
        abbreviated_length=abbreviated_length,
    )
    emit(grounding.format_mapping(result, tbox, file_format), output)
    for path in found.missing_paths:
        talk(f"{scene}: there is no prim {path}; its row has the status missing")
