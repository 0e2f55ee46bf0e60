"""usd2kg build: the knowledge graphs of scenes."""

import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from typer import Argument, Option

from usd2kg.cli.build_summary import summarize_build, summary_text
from usd2kg.cli.grounder_session import show_progress
from usd2kg.cli.options.bundles import check_files, expand_bundles
from usd2kg.cli.options.common import BaseIri, JsonOutput, OntologyFile
from usd2kg.cli.options.graph import AnnotationOptions, MergedImports, Profile, SpatialOptions
from usd2kg.cli.options.grounding import GroundingOptions
from usd2kg.cli.options.review import CarryOverOptions
from usd2kg.cli.options.stage import StageOptions
from usd2kg.cli.options.stores import DataAddress, OptionalStore, UpdateAddress
from usd2kg.cli.output import notify, notify_notes, print_json
from usd2kg.cli.scene_build import SceneBuild
from usd2kg.cli.store import check_graph_names, load_graphs, open_for_loading
from usd2kg.errors import GroundingError, OutputError, Usd2kgError
from usd2kg.files import check_writable, stem_of

if TYPE_CHECKING:
    from usd2kg.pipeline import BuildResult
    from usd2kg.stores import SceneStore

__all__ = ["build_command"]


@expand_bundles
def build_command(
    scenes: Annotated[
        list[Path], Argument(metavar="SCENE...", help="USD stages, or files and folders that usd2kg convert reads.")
    ],
    grounding: GroundingOptions,
    carry_over: CarryOverOptions,
    reading: StageOptions,
    spatial: SpatialOptions,
    annotation: AnnotationOptions,
    ontology: OntologyFile = None,
    base: BaseIri = None,
    profile: Profile = "auto",
    merge_imports: MergedImports = False,
    output: Annotated[
        Path | None,
        Option(
            "--output",
            "-o",
            help="Graph to write: .ttl, .trig, .nt, .nq, .rdf, .owl, .jsonld, .ofn or .graphml, compressed if .gz "
            "follows; a folder for several scenes; default: SCENE.ttl in the current folder, or no file with --store.",
        ),
    ] = None,
    store: OptionalStore = None,
    store_update: UpdateAddress = None,
    store_data: DataAddress = None,
    json: JsonOutput = False,
) -> None:
    """Build the knowledge graph of a scene: read it, ground its objects, find relations, write RDF."""
    from usd2kg.graph.iris import default_base  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    if grounding.model.requests.dry_run:
        raise GroundingError("--dry-run prints the prompts of one scene; use it with usd2kg ground")
    carry_over.check(grounding.review.decisions, len(scenes))
    is_filed = store is None or output is not None
    targets: Sequence[Path | None] = _choose_targets(scenes, output) if is_filed else [None] * len(scenes)
    check_files(targets, [*scenes, ontology], grounding, carry_over, reading, spatial)
    opened = None
    if store is not None:
        check_graph_names([base or default_base(str(scene)) for scene in scenes])
        opened = open_for_loading(store, store_update, store_data)
    # One file of decisions may be about several scenes.
    own = carry_over if len(scenes) == 1 else None
    steps = SceneBuild(grounding, reading, spatial, annotation, profile, own)
    steps.check()
    tbox = open_tbox(ontology) if ontology is not None else None
    if tbox is not None:
        notify_notes(tbox)
    summaries, has_failed = [], False
    for source, target in zip(scenes, targets, strict=True):
        start = time.perf_counter()
        try:
            with (
                show_progress(grounding, "read", "ground", "relate", "instantiate", "write", is_wanted=not json),
                steps.run(source, tbox, base) as (result, session),
            ):
                if tbox is None:
                    notify_notes(result.tbox)
                _save(result, merge_imports, target, opened)
                session.report(result.grounding, result.tbox)
        except Usd2kgError as error:
            # Continue with the other scenes.
            if len(scenes) == 1:
                raise
            notify(f"usd2kg: {error}")
            has_failed = True
            continue
        summaries.append(summarize_build(result, str(target or store), time.perf_counter() - start))
        if not json:
            notify(summary_text(summaries[-1]))
    if json:
        print_json(summaries if len(scenes) > 1 else summaries[0])
    if has_failed:
        raise typer.Exit(2)


def _choose_targets(scenes: list[Path], output: Path | None) -> list[Path]:
    """Return the file for each scene's graph.

    Raises:
        OutputError: a file cannot be written, or two scenes have the same one.
        GraphError: the extension of a file names no format.
    """
    from usd2kg.graph import graph_format  # noqa: PLC0415

    if len(scenes) == 1 and not (output is not None and output.is_dir()):
        targets = [output if output is not None else Path(f"{stem_of(scenes[0])}.ttl")]
    else:
        folder = output if output is not None else Path()
        if folder.suffix or (folder.exists() and not folder.is_dir()):
            raise OutputError(f"{folder}: is not a folder; expected one for the graphs of {len(scenes)} scenes")
        folder.mkdir(parents=True, exist_ok=True)
        targets = [folder / f"{stem_of(scene)}.ttl" for scene in scenes]
    if len(set(targets)) < len(targets):
        raise OutputError(
            "two scenes have the same file name, so their graphs would overwrite each other; build them separately"
        )
    for target in targets:
        graph_format(target)
        check_writable(target)
    return targets


def _save(result: "BuildResult", is_merged: bool, target: Path | None, store: "SceneStore | None") -> None:
    """Write a graph to a file, to a store, or to both.

    Merged imports become part of the graph in a file. In a store, they are a separate graph that the scenes share.
    """
    from usd2kg.graph import merge_imports, write_graph  # noqa: PLC0415
    from usd2kg.ontology import read_closure  # noqa: PLC0415

    closure = read_closure(result.tbox, result.graph.imports) if is_merged else None
    for iri in closure.missing if closure is not None else ():
        notify(f"missing-import: <{iri}> is not available and not merged; put its file beside the ontology")
    if target is not None:
        write_graph(result.graph if closure is None else merge_imports(result.graph, closure), target)
    if store is not None:
        from usd2kg.stores import make_named_graph, make_ontology_graph  # noqa: PLC0415 - loads queries

        # The ontology first, so that the store never holds a scene without its classes.
        shared = [make_ontology_graph(result.tbox, closure)] if closure is not None else []
        load_graphs(store, [*shared, make_named_graph(result.graph)])
