"""plan_batch and run_batch: select the scenes of a batch that still need building, and build them."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple, Protocol
from urllib.parse import quote

from usd2kg.batch.job import LAYERS, Job, Outcome
from usd2kg.batch.layers import ChangedFiles
from usd2kg.batch.manifest import JobStatus, Manifest, Record, SourceState
from usd2kg.batch.scene_files import SceneFile, output_names
from usd2kg.errors import OutputError, Usd2kgError, one_line
from usd2kg.files import hash_file
from usd2kg.graph.iris import check_base

__all__ = ["BatchPlan", "BatchStore", "Built", "load_finished", "plan_batch", "run_batch"]

DEFAULT_BASE = "https://example.org/"


class Built(NamedTuple):
    """One scene that was built or that failed."""

    job: Job
    record: Record


class BatchStore(Protocol):
    """A store that receives the graphs, too."""

    address: str

    def load(self, job: Job) -> None:
        """Add or replace the graph of a job."""
        ...

    def has(self, job: Job) -> bool:
        """Return whether the store has a graph of a job, maybe an older one."""
        ...


class BatchPlan(NamedTuple):
    """The work of a batch."""

    jobs: tuple[Job, ...]
    """Scenes to build, largest files first, so that the last scenes to finish are short."""
    finished: tuple[Built, ...]
    """Scenes that are already built."""


@dataclass(frozen=True)
class _Place:
    """Destinations of the outputs."""

    folder: Path
    ending: str
    base: str

    def job(self, scene: SceneFile, name: str) -> Job:
        iri = self.base + "/".join(quote(part, safe="") for part in name.split("/")) + "/"
        return Job(scene.name, scene.path, self.folder / f"{name}{self.ending}", check_base(iri))


def plan_batch(
    scenes: Sequence[SceneFile],
    folder: Path,
    manifest: Manifest,
    *,
    options: str,
    ending: str = ".ttl",
    base: str = DEFAULT_BASE,
    is_again: bool = False,
) -> BatchPlan:
    """Return the scenes to build and the finished scenes.

    A scene is finished if it was built with the same options, its file has the same size and time, the layers that it
    refers to have the same size and either the same time or the same content, and its graph has the checksum that it
    was written with.

    Args:
        scenes: the scenes.
        folder: for the graphs, in folders as those of the scenes.
        manifest: the records of earlier runs.
        options: hash of all else that the graphs depend on.
        ending: file ending of the graphs.
        base: beginning of the namespaces; the name of the scene follows.
        is_again: whether to build all scenes again.

    Raises:
        OutputError: a graph would overwrite a scene.
    """
    place, names = _Place(folder.absolute(), ending, base), output_names(scenes)
    sources = {scene.path.resolve() for scene in scenes}
    jobs: list[tuple[int, Job]] = []
    finished: list[Built] = []
    changed = ChangedFiles()
    for scene in scenes:
        job = place.job(scene, names[scene.name])
        if job.target.resolve() in sources:
            raise OutputError(f"{job.target}: is a scene of the batch and would be overwritten; choose another folder")
        record, state = manifest.get(scene.name), SourceState.of(scene.path)
        is_done = record is not None and _is_finished(record, job, state, options)
        if record is not None and is_done and not is_again and not changed.any_of(record.layers, scene.path):
            finished.append(Built(job, record))
        else:
            jobs.append((-state.bytes, job))
    return BatchPlan(
        tuple(job for _, job in sorted(jobs, key=lambda entry: (entry[0], entry[1].name))), tuple(finished)
    )


def _is_finished(record: Record, job: Job, state: SourceState, options: str) -> bool:
    if record.status is not JobStatus.DONE or (record.options, record.source) != (options, state):
        return False
    return job.target.is_file() and hash_file(job.target) == record.sha256


def run_batch(
    plan: BatchPlan,
    manifest: Manifest,
    outcomes: Iterable[Outcome],
    *,
    options: str,
    folder: Path,
    store: BatchStore | None = None,
) -> Iterator[Built]:
    """Yield each scene after its record is written to disk.

    Args:
        plan: what is to be done.
        manifest: receives the records.
        outcomes: those of the jobs, as they end; each graph is in its file by then.
        options: as in `plan_batch`.
        folder: as in `plan_batch`.
        store: receives the graphs, too.

    Raises:
        OutputError: the manifest cannot be written.
    """
    states = {job.name: SourceState.of(job.source) for job in plan.jobs if job.source.exists()}
    for outcome in outcomes:
        error = outcome.error
        if outcome.summary is not None and store is not None:
            error = _load(outcome.job, store)
        record = _record(outcome, error, options, states.get(outcome.job.name, SourceState(0, 0)), folder.absolute())
        if store is not None and not error:
            record = replace(record, store=store.address)
        manifest.add(record)
        yield Built(outcome.job, record)


def load_finished(plan: BatchPlan, manifest: Manifest, store: BatchStore) -> Iterator[Built]:
    """Yield each finished scene whose graph a store lacks, after it is loaded, or with the error why it cannot be.

    Raises:
        OutputError: the manifest cannot be written.
    """
    for job, record in plan.finished:
        if record.store == store.address and store.has(job):
            continue
        error = _load(job, store)
        if error:
            yield Built(job, replace(record, error=error))
        else:
            manifest.add(replace(record, store=store.address))
            yield Built(job, record)


def _load(job: Job, store: BatchStore) -> str:
    """Load the graph of a job into a store; return the error, empty if there is none."""
    try:
        store.load(job)
    except Usd2kgError as problem:
        return one_line(problem)
    return ""


def _record(outcome: Outcome, error: str, options: str, source: SourceState, folder: Path) -> Record:
    job, is_done = outcome.job, outcome.summary is not None and not error
    summary = dict(outcome.summary or {}) if is_done else {}
    layers = tuple(summary.pop(LAYERS, ()))
    return Record(
        scene=job.name,
        status=JobStatus.DONE if is_done else JobStatus.FAILED,
        options=options,
        source=source,
        output=job.target.relative_to(folder).as_posix() if is_done else "",
        sha256=hash_file(job.target) if is_done else "",
        error=error,
        attempts=outcome.attempts,
        seconds=round(outcome.seconds, 3),
        finished=datetime.now(UTC).isoformat(timespec="seconds"),
        layers=layers,
        summary=summary,
    )
