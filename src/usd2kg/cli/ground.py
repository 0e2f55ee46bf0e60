"""usd2kg ground: the class of each object, without a graph."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Option

from usd2kg.cli.grounder_session import GrounderSession, open_grounder_session, show_progress
from usd2kg.cli.options.bundles import check_files, expand_bundles
from usd2kg.cli.options.common import BaseIri, OntologyFile, SceneFile, TextFile
from usd2kg.cli.options.grounding import AbbreviatedLength, GroundingOptions
from usd2kg.cli.options.review import CarryOverOptions
from usd2kg.cli.options.stage import StageOptions
from usd2kg.cli.output import emit, notify, notify_notes
from usd2kg.errors import GroundingError

if TYPE_CHECKING:
    from usd2kg.grounding import Grounding
    from usd2kg.ontology import TBox
    from usd2kg.scene import Scene

__all__ = ["ground_command"]

_CSV, _SSSOM = "csv", "sssom"
_FORMAT_OF_SUFFIX = {".json": "json", ".tsv": _SSSOM}
_INTERRUPTED = 130
"""Exit code after SIGINT, by the convention of shells: 128 and the number of the signal."""


@expand_bundles
def ground_command(
    scene: SceneFile,
    grounding: GroundingOptions,
    carry_over: CarryOverOptions,
    reading: StageOptions,
    ontology: OntologyFile = None,
    abbreviated_length: AbbreviatedLength = 4,
    paths: Annotated[
        Path | None,
        Option("--paths", help="CSV file with a column path: ground these prims only; default: all objects."),
    ] = None,
    file_format: Annotated[
        str | None,
        Option(
            "--format",
            help="csv, json, or sssom, which --license and --mapping-date describe; default: by the file "
            "extension (.json, .tsv), otherwise csv.",
        ),
    ] = None,
    base: BaseIri = None,
    license_iri: Annotated[
        str | None, Option("--license", help="IRI of the licence of the mapping; default: unspecified.")
    ] = None,
    mapping_date: Annotated[
        str | None, Option("--mapping-date", help="Date of the mapping, like 2026-07-15; default: none.")
    ] = None,
    output: TextFile = None,
) -> None:
    """Ground the objects of a scene: print class, confidence and concept of each."""
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.grounding import check_format, format_mapping, ground, read_paths  # noqa: PLC0415
    from usd2kg.grounding.built_in_choice import stated_places  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    evidence, regime = grounding.evidence_groups, grounding.naming_regime
    if file_format is None:
        file_format = _FORMAT_OF_SUFFIX.get(output.suffix.lower() if output is not None else "", _CSV)
    if file_format != _SSSOM:
        check_format(file_format)
        if license_iri or mapping_date:
            raise GroundingError("--license and --mapping-date need --format sssom; leave them out")
    carry_over.check(grounding.review.decisions, 1)
    for target in (output, grounding.review.queue):
        if target is not None:
            check_writable(target)
    check_files([output], [scene, ontology, paths], grounding, carry_over, reading)
    wanted = read_paths(paths) if paths is not None else None
    read_options = reading.read_options()
    with show_progress(grounding, "read", "ground"):
        found = read_scene(scene, paths=wanted, options=read_options)
        tbox = open_tbox(ontology, found, stated=stated_places(grounding.review.decisions))
        notify_notes(tbox)
        with open_grounder_session(grounding, found, tbox, scene, read_options, carry_over) as session:
            if session.model is not None and grounding.model.requests.dry_run:
                _print_dry_run(session, found, tbox, wanted, abbreviated_length, output)
                return
            result = ground(
                found,
                tbox,
                session.grounder,
                regime=regime,
                evidence=evidence,
                paths=wanted,
                decisions=session.decisions,
                carried=session.carried,
                abbreviated_length=abbreviated_length,
            )
    if file_format == _SSSOM:
        emit(_format_sssom(result, tbox, found, base, license_iri, mapping_date), output)
    else:
        emit(format_mapping(result, tbox, file_format), output)
    for path in found.missing_paths:
        notify(f"{scene}: no prim {path}; its row has the status missing")
    session.report(result, tbox)
    if session.model is not None and session.model.report.is_interrupted:
        raise typer.Exit(_INTERRUPTED)


def _print_dry_run(
    session: GrounderSession,
    scene: "Scene",
    tbox: "TBox",
    paths: list[str] | None,
    abbreviated_length: int,
    output: Path | None,
) -> None:
    """Print the prompts that would be sent to the model for the prims in `paths`, or for all objects."""
    from usd2kg.cli.model_report import print_prompts  # noqa: PLC0415
    from usd2kg.grounding import view_objects  # noqa: PLC0415

    assert session.model is not None
    options = session.options
    views = view_objects(scene, options.naming_regime, options.evidence_groups, abbreviated_length)
    wanted = [(obj.prim_path, view) for obj, view in views if paths is None or obj.prim_path in paths]
    views_for_model = session.views_for_model(wanted, tbox)
    print_prompts(session.model.plan(views_for_model, tbox), len(views_for_model), session.model.tariff, output)


def _format_sssom(
    grounding: "Grounding",
    tbox: "TBox",
    scene: "Scene",
    base: str | None,
    license_iri: str | None,
    mapping_date: str | None,
) -> str:
    from usd2kg.graph import UNSPECIFIED_LICENSE, format_sssom  # noqa: PLC0415

    names = {obj.prim_path: obj.display_name or obj.name for obj in scene.objects}
    license_iri = license_iri or UNSPECIFIED_LICENSE
    return format_sssom(grounding, tbox, names, base=base, license_iri=license_iri, mapping_date=mapping_date)
