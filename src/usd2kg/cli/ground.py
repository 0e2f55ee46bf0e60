"""usd2kg ground: the mapping of prims to classes, without a graph."""

from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.carry_options import CarryOptions
from usd2kg.cli.grounding_run import GroundingOptions, check_files_apart, open_run
from usd2kg.cli.groups import with_groups
from usd2kg.cli.model_options import ModelOptions
from usd2kg.cli.options import AbbreviatedLength, OntologyFile, ReadingOptions, SceneFile
from usd2kg.cli.output import emit, talk
from usd2kg.errors import GroundingError

__all__ = ["ground_command"]

_CSV, _SSSOM = "csv", "sssom"
_FORMATS = {".json": "json", ".tsv": _SSSOM}
"""Ending of a file → the format that it has where none is asked for."""
_INTERRUPTED = 130
"""Exit code of a program that the user stopped: 128 and the signal's number."""


@with_groups
def ground_command(
    scene: SceneFile,
    chosen: GroundingOptions,
    asked: ModelOptions,
    carrying: CarryOptions,
    reading: ReadingOptions,
    ontology: OntologyFile = None,
    abbreviated_length: AbbreviatedLength = 4,
    paths: Annotated[
        Path | None, typer.Option("--paths", help="Answer only for the prims in the column 'path' of this CSV file.")
    ] = None,
    file_format: Annotated[
        str | None,
        typer.Option("--format", help="csv, json or sssom; default: by the file ending (.json, .tsv), else csv."),
    ] = None,
    base: Annotated[
        str | None,
        typer.Option("--base", help="For sssom: IRI under which the individuals lie; default: by file name."),
    ] = None,
    license_iri: Annotated[
        str | None, typer.Option("--license", help="For sssom: IRI of the mapping's licence; default: unspecified.")
    ] = None,
    mapping_date: Annotated[
        str | None,
        typer.Option("--mapping-date", help="For sssom: when the mapping was made, as 2026-07-15; default: not told."),
    ] = None,
    output: Annotated[Path | None, typer.Option("--output", "-o", help="File to write; default: stdout.")] = None,
) -> None:
    """Ground the objects of a scene: print path, class, label, confidence, status and grounder of each."""
    from usd2kg import grounding  # noqa: PLC0415
    from usd2kg.cli.model_run import show_plan  # noqa: PLC0415
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.graph import UNSPECIFIED_LICENSE, format_sssom  # noqa: PLC0415
    from usd2kg.grounding import view_objects  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    groups, naming_regime = chosen.groups, chosen.naming_regime
    if file_format is None:
        file_format = _FORMATS.get(output.suffix.lower() if output is not None else "", _CSV)
    if file_format != _SSSOM:
        grounding.check_format(file_format)
        if base or license_iri or mapping_date:
            raise GroundingError("--base, --license and --mapping-date belong to --format sssom; leave them out")
    carrying.check(asked.decisions, 1)
    for target in (output, asked.queue):
        if target is not None:
            check_writable(target)
    check_files_apart([output], [scene, ontology, paths, reading.objects], chosen, asked, carrying)
    wanted = grounding.read_paths(paths) if paths is not None else None
    tbox = open_tbox(ontology)
    options = reading.read_options()
    found = read_scene(scene, paths=wanted, options=options)
    with open_run(chosen, asked, found, tbox, scene, options, carrying) as run:
        if run.model is not None and asked.dry_run:
            views = view_objects(found, naming_regime, groups, abbreviated_length)
            shown = [(obj.prim_path, view) for obj, view in views if wanted is None or obj.prim_path in wanted]
            open_views = run.unsure(shown, tbox)
            show_plan(run.model.plan(open_views, tbox), len(open_views), run.model.tariff, output)
            return
        result = grounding.ground(
            found,
            tbox,
            run.grounder,
            regime=naming_regime,
            evidence=groups,
            paths=wanted,
            decisions=run.decisions,
            carried=run.carried,
            abbreviated_length=abbreviated_length,
        )
    if file_format == _SSSOM:
        names = {obj.prim_path: obj.display_name or obj.name for obj in found.objects}
        text = format_sssom(
            result,
            tbox,
            names,
            base=base,
            license_iri=license_iri or UNSPECIFIED_LICENSE,
            mapping_date=mapping_date,
        )
    else:
        text = grounding.format_mapping(result, tbox, file_format)
    emit(text, output)
    for path in found.missing_paths:
        talk(f"{scene}: there is no prim {path}; its row has the status missing")
    run.tell(result, asked, tbox)
    if run.model is not None and run.model.report.is_interrupted:
        raise typer.Exit(_INTERRUPTED)
