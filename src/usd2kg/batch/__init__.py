"""Many scenes: found by patterns, built by a pool of processes, recorded in a manifest that survives a crash."""

from usd2kg.batch.job import Job, Outcome, Task
from usd2kg.batch.manifest import JobStatus, Manifest, Record
from usd2kg.batch.process_pool import PoolLimits, run_in_processes
from usd2kg.batch.run import BatchPlan, BatchStore, Built, load_finished, plan_batch, run_batch
from usd2kg.batch.scene_files import SceneFile, find_scene_files

__all__ = [
    "BatchPlan",
    "BatchStore",
    "Built",
    "Job",
    "JobStatus",
    "Manifest",
    "Outcome",
    "PoolLimits",
    "Record",
    "SceneFile",
    "Task",
    "find_scene_files",
    "load_finished",
    "plan_batch",
    "run_batch",
    "run_in_processes",
]
