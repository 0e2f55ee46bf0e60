"""usd2kg batch: the knowledge graphs of many scenes."""

import hashlib
import os
import signal
import time
from collections.abc import Callable, Generator, Iterable, Mapping
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer import Argument, Option

from usd2kg.cli.batch_progress import BatchProgress
from usd2kg.cli.options.bundles import bundle_files, check_files, expand_bundles
from usd2kg.cli.options.common import JsonOutput, OntologyFile
from usd2kg.cli.options.graph import AnnotationOptions, MergedImports, Profile, SpatialOptions
from usd2kg.cli.options.grounding import GroundingOptions
from usd2kg.cli.options.stage import StageOptions
from usd2kg.cli.options.stores import DataAddress, OptionalStore, UpdateAddress
from usd2kg.cli.output import count_noun, notify, notify_notes, print_json
from usd2kg.cli.scene_build import SceneBuild
from usd2kg.cli.store import open_for_loading
from usd2kg.errors import GroundingError, OutputError
from usd2kg.version import VERSION

if TYPE_CHECKING:
    from usd2kg.batch import BatchPlan, Built, Job, Manifest, Outcome, PoolLimits
    from usd2kg.ontology import TBox
    from usd2kg.stores import SceneStore

__all__ = ["batch_command"]

MANIFEST = "manifest.jsonl"
_SUMMARY = ("prims", "objects", "classes", "status", "confidence", "relations", "triples", "diagnostics")
"""Keys of the build summary that a record keeps."""
_LOCK_WAIT_S = 2.0


@dataclass(frozen=True)
class _BuildTask:
    """The task of each worker, sent to the worker processes."""

    steps: SceneBuild
    ontology: Path | None
    merges_imports: bool

    def prepare(self) -> "Callable[[Job], Mapping[str, Any]]":
        from usd2kg.pipeline import open_tbox  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        tbox = open_tbox(self.ontology) if self.ontology is not None else None
        return lambda job: self._build(job, tbox)

    def _build(self, job: "Job", tbox: "TBox | None") -> Mapping[str, Any]:
        from usd2kg.batch.job import LAYERS  # noqa: PLC0415
        from usd2kg.batch.layers import relative_files  # noqa: PLC0415
        from usd2kg.cli.build_summary import summarize_build  # noqa: PLC0415
        from usd2kg.graph import merge_imports, write_graph  # noqa: PLC0415
        from usd2kg.ontology import read_closure  # noqa: PLC0415

        start, begun_ns = time.perf_counter(), time.time_ns()
        with self.steps.run(job.source, tbox, job.base) as (result, session):
            graph = result.graph
            if self.merges_imports:
                graph = merge_imports(graph, read_closure(result.tbox, graph.imports))
            try:
                job.target.parent.mkdir(parents=True, exist_ok=True)
            except OSError as error:
                raise OutputError(f"{job.target.parent}: cannot be created ({error.strerror})") from error
            write_graph(graph, job.target)
            session.check_completions()
        summary = summarize_build(result, "", time.perf_counter() - start)
        layers = relative_files(result.scene.files, job.source, begun_ns)
        return {LAYERS: layers, **{key: summary[key] for key in _SUMMARY}}


@expand_bundles
def batch_command(
    places: Annotated[
        list[str],
        Argument(
            metavar="SCENE|FOLDER|PATTERN...",
            help="Scenes, folders with stages, or patterns in quotes, such as 'scenes/**/*.usd'.",
        ),
    ],
    output: Annotated[
        Path,
        Option(
            "--output", "-o", help="Folder for the manifest and the graphs, in subfolders like those of the scenes."
        ),
    ],
    grounding: GroundingOptions,
    reading: StageOptions,
    spatial: SpatialOptions,
    annotation: AnnotationOptions,
    ontology: OntologyFile = None,
    base: Annotated[
        str,
        Option(
            "--base", help="Prefix of the namespaces of individuals, ending in / or #; the scene's name is appended."
        ),
    ] = "https://example.org/",
    profile: Profile = "auto",
    merge_imports: MergedImports = False,
    file_format: Annotated[
        str,
        Option(
            "--format",
            help="File extension of the graphs: ttl, nt, trig, nq, rdf, owl, jsonld, ofn or graphml, also with .gz.",
        ),
    ] = "ttl",
    exclude_scenes: Annotated[
        list[str] | None,
        Option("--exclude-scenes", metavar="PATTERN", help="Scenes to exclude, such as '**/assets/**'. Repeatable."),
    ] = None,
    workers: Annotated[
        int | None,
        Option("--workers", min=1, max=1024, help="Scenes built at the same time; default: one per CPU core."),
    ] = None,
    time_limit: Annotated[
        float,
        Option("--time-limit", min=1, help="Seconds after which a scene is stopped, tried once more, and reported."),
    ] = 600.0,
    memory_limit: Annotated[
        int,
        Option("--memory-limit", min=256, help="MiB of memory after which a scene is stopped likewise; Linux only."),
    ] = 8192,
    again: Annotated[bool, Option("--again", help="Rebuild finished scenes, too.")] = False,
    on_ray: Annotated[
        bool,
        Option("--ray", help="Run on the Ray cluster at RAY_ADDRESS, or on a local one (extra ray)."),
    ] = False,
    store: OptionalStore = None,
    store_update: UpdateAddress = None,
    store_data: DataAddress = None,
    json: JsonOutput = False,
) -> None:
    """Build the graphs of many scenes in parallel; finished graphs survive a crash and are not rebuilt."""
    # Loads OpenUSD, too slow for --help.
    from usd2kg.batch import Manifest, PoolLimits, find_scene_files, plan_batch, run_batch  # noqa: PLC0415
    from usd2kg.batch.folder import open_batch_folder  # noqa: PLC0415
    from usd2kg.graph import graph_format  # noqa: PLC0415
    from usd2kg.pipeline import open_tbox  # noqa: PLC0415

    for_one_scene = grounding.review.queue, grounding.model.write_alignment
    if grounding.model.requests.dry_run or any(path is not None for path in for_one_scene):
        raise GroundingError(
            "--dry-run, --queue and --write-alignment are for one scene; use them with usd2kg ground or build"
        )
    ending = f".{file_format.removeprefix('.')}"
    graph_format(Path(f"graph{ending}"))
    scenes = find_scene_files(places, exclude_scenes or ())
    check_files([], [scene.path for scene in scenes], grounding, reading, spatial)
    steps = SceneBuild(grounding, reading, spatial, annotation, profile)
    steps.check()
    tboxes = [open_tbox(name) for name in ([ontology] if ontology is not None else ["home", "places"])]
    for tbox in tboxes:
        notify_notes(tbox)
    task = _BuildTask(steps, ontology, merge_imports)
    options = _hash_options(task, tboxes, ending, base)
    limits = PoolLimits(workers or _count_cores(), time_limit, memory_limit)
    loaded = None if store is None else _LoadedStore(open_for_loading(store, store_update, store_data))
    start = time.perf_counter()
    # Like Ctrl+C: the workers are stopped, and finished graphs are kept.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with open_batch_folder(output, _LOCK_WAIT_S), Manifest(output / MANIFEST) as manifest:
        plan = plan_batch(scenes, output, manifest, options=options, ending=ending, base=base, is_again=again)
        if plan.finished:
            notify(f"{count_noun(len(plan.finished), 'scene')} of {len(scenes)} already finished")
        added: list[Built] = []
        built: list[Built] = []
        outcomes = _outcomes(task, plan.jobs, limits, on_ray=on_ray)
        with BatchProgress(plan.jobs, sum(1 for _ in plan.finished)) as progress, closing(outcomes):
            try:
                if loaded is not None:
                    added += loaded.load_finished(plan, manifest)
                for one in run_batch(plan, manifest, outcomes, options=options, folder=output, store=loaded):
                    built.append(one)
                    progress.show(one)
            except KeyboardInterrupt:
                notify(f"stopped after {count_noun(len(built), 'scene')}; the same command resumes from there")
                raise typer.Exit(130) from None
            except ChildProcessError as error:
                raise GroundingError(f"{error}; --verbose shows why, with one worker") from error
    failed = [one.record for one in (*added, *built) if one.record.error]
    seconds = time.perf_counter() - start
    summary = {
        "scenes": len(scenes),
        "built": sum(not one.record.error for one in built),
        "finished_before": len(plan.finished),
        "failed": {record.scene: record.error for record in failed},
        "objects": sum(one.record.summary.get("objects", 0) for one in built),
        "triples": sum(one.record.summary.get("triples", 0) for one in built),
        "manifest": str(output / MANIFEST),
        "seconds": round(seconds, 3),
    }
    if json:
        print_json(summary)
    else:
        notify(_summary_text(summary))
    if failed:
        raise typer.Exit(1)


def _outcomes(task: _BuildTask, jobs: "Iterable[Job]", limits: "PoolLimits", *, on_ray: bool) -> "Generator[Outcome]":
    if on_ray:
        from usd2kg.batch.ray_pool import run_on_ray  # noqa: PLC0415 - an extra

        return run_on_ray(task, jobs, limits)
    from usd2kg.batch import run_in_processes  # noqa: PLC0415

    return run_in_processes(task, jobs, limits)


class _LoadedStore:
    """A store that receives the graphs of a batch."""

    def __init__(self, store: "SceneStore") -> None:
        self.address = store.address
        self._store = store
        self._known = {graph.iri for graph in store.graphs()}

    def load(self, job: "Job") -> None:
        from usd2kg.stores import read_named_graph  # noqa: PLC0415

        self._store.load(read_named_graph(job.target))

    def has(self, job: "Job") -> bool:
        return job.base.rstrip("/") in self._known

    def load_finished(self, plan: "BatchPlan", manifest: "Manifest") -> "list[Built]":
        """Load the graphs of finished scenes that are not in the store; return their scenes."""
        from usd2kg.batch import load_finished  # noqa: PLC0415

        added = list(load_finished(plan, manifest, self))
        if added:
            count = sum(not one.record.error for one in added)
            notify(f"{count_noun(count, 'finished graph')} loaded into {self.address}")
        return added


def _hash_options(task: _BuildTask, tboxes: "Iterable[TBox]", ending: str, base: str) -> str:
    """Return a hash of all inputs of the graphs other than the scenes: options, their files, ontology and version."""
    steps = task.steps
    bundles = (steps.grounding, steps.reading, steps.spatial, steps.annotation)
    digest = hashlib.sha256()
    for text in (VERSION, *(tbox.content_hash for tbox in tboxes), repr(task), ending, base):
        digest.update(text.encode() + b"\0")
    for path in (path for bundle in bundles for path, is_output in bundle_files(bundle) if not is_output):
        try:
            digest.update(path.read_bytes() + b"\0")
        except OSError as error:
            raise GroundingError(f"{path}: cannot be read ({error.strerror})") from error
    return digest.hexdigest()[:16]


def _count_cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _summary_text(summary: Mapping[str, Any]) -> str:
    failed, seconds = summary["failed"], summary["seconds"]
    rate = f", {60 * summary['built'] / seconds:,.0f} scenes per minute" if summary["built"] else ""
    parts = [f"{count_noun(summary['scenes'], 'scene')}: {summary['built']} built in {seconds:.1f} s{rate}"]
    if summary["finished_before"]:
        parts.append(f"{summary['finished_before']} already finished")
    if failed:
        parts.append(f"{len(failed)} failed")
    return (
        f"{', '.join(parts)}\n  {summary['objects']:,} objects, {summary['triples']:,} triples\n"
        f"  manifest: {summary['manifest']}"
    )
