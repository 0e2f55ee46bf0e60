"""usd2kg build: the whole chain."""

import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from usd2kg.cli.carry_options import CarryOptions
from usd2kg.cli.grounding_run import GroundingOptions, check_files_apart, open_run
from usd2kg.cli.groups import with_groups
from usd2kg.cli.model_options import ModelOptions
from usd2kg.cli.options import (
    DataAddress,
    JsonOutput,
    MergeImports,
    OntologyFile,
    ReadingOptions,
    RelatingOptions,
    StorePlace,
    UpdateAddress,
    WritingOptions,
)
from usd2kg.cli.output import print_json, talk
from usd2kg.cli.store import check_names, open_place, store_graphs
from usd2kg.errors import GroundingError, OutputError, Usd2kgError

if TYPE_CHECKING:
    from usd2kg.pipeline import BuildResult
    from usd2kg.stores import SceneStore

__all__ = ["build_command", "summarize", "summary_text"]

_CONFIDENCE_BANDS = ((0.8, "0.8 and more"), (0.5, "0.5 to 0.8"), (0.0, "below 0.5"))


@with_groups
def build_command(
    scenes: Annotated[list[Path], typer.Argument(metavar="SCENE...", help="One or more USD stages.")],
    chosen: GroundingOptions,
    asked: ModelOptions,
    carrying: CarryOptions,
    reading: ReadingOptions,
    relating: RelatingOptions,
    writing: WritingOptions,
    ontology: OntologyFile = None,
    base: Annotated[
        str | None,
        typer.Option("--base", help="IRI under which the individuals lie, ending in / or #; default: by file name."),
    ] = None,
    profile: Annotated[
        str, typer.Option("--profile", help="How objects are written: auto (default), soma or plain.")
    ] = "auto",
    merge_imports: MergeImports = False,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            help="Graph to write: .ttl, .trig, .nt, .nq, .rdf, .jsonld, .ofn or .graphml, packed with .gz after it; a "
            "folder for several scenes; default: SCENE.ttl here, or no file beside --store.",
        ),
    ] = None,
    store: StorePlace = None,
    store_update: UpdateAddress = None,
    store_data: DataAddress = None,
    json: JsonOutput = False,
) -> None:
    """Build the knowledge graph of a scene: read it, ground its objects, relate them, write RDF."""
    from usd2kg.graph.iris import default_base  # noqa: PLC0415
    from usd2kg.pipeline import build, open_tbox  # noqa: PLC0415 - opens OpenUSD, too slow for --help
    from usd2kg.scene import read_scene  # noqa: PLC0415

    if asked.dry_run:
        raise GroundingError("--dry-run shows the prompts of one scene; expected it with usd2kg ground")
    carrying.check(asked.decisions, len(scenes))
    targets: Sequence[Path | None] = [None] * len(scenes)
    if store is None or output is not None:
        targets = _targets(scenes, output)
    check_files_apart(targets, [*scenes, ontology, reading.objects, relating.relation_rules], chosen, asked, carrying)
    keeper = None
    if store is not None:
        check_names([base or default_base(str(scene)) for scene in scenes])
        keeper = open_place(store, store_update, store_data)
    groups, naming_regime = chosen.groups, chosen.naming_regime
    options = reading.read_options()
    relations = relating.relation_options()
    written = writing.graph_options()
    tbox = open_tbox(ontology)
    for note in tbox.notes:
        talk(f"{note.code}: {note.message}")
    summaries, failures = [], []
    for scene, target in zip(scenes, targets, strict=True):
        start = time.perf_counter()
        try:
            read = read_scene(scene, options=options)
            with open_run(chosen, asked, read, tbox, scene, options, carrying) as run:
                result = build(
                    read,
                    tbox,
                    grounder=run.grounder,
                    regime=naming_regime,
                    evidence=groups,
                    decisions=run.decisions,
                    carried=run.carried,
                    base=base,
                    profile=profile,
                    graph_options=written,
                    relations=relations,
                )
            _keep(result, merge_imports, target, keeper)
            run.tell(result.grounding, asked, tbox)
        except Usd2kgError as error:
            # One bad scene must not cost the others; with one scene it is simply the error.
            if len(scenes) == 1:
                raise
            talk(f"usd2kg: {error}")
            failures.append(scene)
            continue
        written_to = str(target or store)
        summary = {**summarize(result), "output": written_to, "seconds": round(time.perf_counter() - start, 3)}
        summaries.append(summary)
        if not json:
            talk(summary_text(summary))
    if json:
        print_json(summaries if len(scenes) > 1 else summaries[0])
    if failures:
        raise typer.Exit(2)


def _targets(scenes: list[Path], output: Path | None) -> list[Path]:
    """Return where each scene's graph goes, checked before any work is spent."""
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.graph import graph_format  # noqa: PLC0415

    if len(scenes) == 1 and not (output is not None and output.is_dir()):
        targets = [output if output is not None else Path(f"{scenes[0].stem}.ttl")]
    else:
        folder = output if output is not None else Path()
        if folder.suffix or (folder.exists() and not folder.is_dir()):
            raise OutputError(f"{folder}: is not a folder; expected one for the graphs of {len(scenes)} scenes")
        folder.mkdir(parents=True, exist_ok=True)
        targets = [folder / f"{scene.stem}.ttl" for scene in scenes]
    if len(set(targets)) < len(targets):
        raise OutputError(
            "two scenes have the same file name, so their graphs would overwrite each other; build them apart"
        )
    for target in targets:
        graph_format(target)
        check_writable(target)
    return targets


def _keep(result: "BuildResult", merges: bool, target: Path | None, keeper: "SceneStore | None") -> None:
    """Write the graph to a file, put it into a store, or both.

    What is merged in stands in the file with the scene; in a store it is a graph of its own, which scenes share.
    """
    from usd2kg.graph import merge_imports, write_graph  # noqa: PLC0415
    from usd2kg.ontology import read_closure  # noqa: PLC0415
    from usd2kg.stores import make_named_graph, make_ontology_graph  # noqa: PLC0415

    closure = read_closure(result.tbox, result.graph.imports) if merges else None
    for iri in closure.missing if closure is not None else ():
        talk(f"missing-import: <{iri}> is not at hand, so it is not merged in; put it beside the ontology's file")
    if target is not None:
        write_graph(result.graph if closure is None else merge_imports(result.graph, closure), target)
    if keeper is not None:
        # Asked together, the ontology comes first, so that no scene is there whose classes are not.
        shared = [make_ontology_graph(result.tbox, closure)] if closure is not None else []
        store_graphs(keeper, [*shared, make_named_graph(result.graph)])


def summarize(result: "BuildResult") -> dict[str, Any]:
    """Return what a build gave, in numbers."""
    from usd2kg.relations import ALL_KINDS  # noqa: PLC0415

    predictions = result.grounding.predictions
    found = Counter(relation.kind for relation in result.graph.relations)
    bands = dict.fromkeys((label for _, label in _CONFIDENCE_BANDS), 0)
    for p in predictions:
        if p.confidence is not None:
            bands[next(label for floor, label in _CONFIDENCE_BANDS if p.confidence >= floor)] += 1
    status: dict[str, int] = {}
    for p in predictions:
        status[p.status.value] = status.get(p.status.value, 0) + 1
    return {
        "scene": result.scene.source,
        "prims": result.scene.prim_count,
        "objects": len(result.scene.objects),
        "classes": len(result.graph.classes),
        "status": status,
        "confidence": bands,
        "is_calibrated": result.grounding.is_calibrated,
        "relations": {kind: found[kind] for kind in ALL_KINDS if found[kind]},
        "triples": len(result.graph.triples),
        "diagnostics": len(result.scene.diagnostics),
    }


def summary_text(summary: dict[str, Any]) -> str:
    """Return the numbers of a build as a few lines."""
    relations = ", ".join(f"{count} {kind}" for kind, count in summary["relations"].items()) or "none"
    bands = ", ".join(f"{count} at {band}" for band, count in summary["confidence"].items() if count) or "none"
    status = ", ".join(f"{count} {name}" for name, count in summary["status"].items())
    calibration = "" if summary["is_calibrated"] else " (not calibrated: it only ranks)"
    lines = [
        f"{summary['scene']}: {summary['objects']} objects of {summary['classes']} classes ({status})",
        f"  confidence: {bands}{calibration}",
        f"  relations: {relations}; {summary['triples']} triples in {summary['seconds']:.2f} s",
    ]
    if summary["diagnostics"]:
        lines.append(f"  {summary['diagnostics']} diagnostics: usd2kg inspect {summary['scene']}")
    return "\n".join([*lines, f"  written to {summary['output']}"])
