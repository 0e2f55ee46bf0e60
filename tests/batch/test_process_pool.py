"""Workers that die, hang, grow or fail."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest

from tests.batch.tasks import Acting, Unprepared
from usd2kg.batch import Job, Outcome, PoolLimits, run_in_processes

LIMITS = PoolLimits(workers=2, seconds=60, memory_mib=4096)


def run(folder: Path, names: Iterable[str], limits: PoolLimits = LIMITS) -> dict[str, Outcome]:
    jobs = [Job(name, folder / f"{name}.usd", folder / f"{name}.ttl", "https://my.lab/") for name in names]
    return {outcome.job.name: outcome for outcome in run_in_processes(Acting(folder), jobs, limits)}


def test_jobs_share_the_workers(tmp_path: Path):
    found = run(tmp_path, [f"good-{number}" for number in range(8)])
    assert len(found) == 8
    processes = {outcome.summary["process"] for outcome in found.values() if outcome.summary}
    prepared = {int(path.name.partition("-")[2]) for path in tmp_path.glob("prepared-*")}
    # A worker may get ready when the others have done all.
    assert processes <= prepared and len(prepared) <= 2
    assert all((tmp_path / f"{name}.ttl").read_text() == name for name in found)


def test_failures_end_one_job_alone_and_are_not_tried_again(tmp_path: Path):
    found = run(tmp_path, ["broken", "bug", "deep", "good"])
    assert found["broken"].error == f"{tmp_path}/broken.usd: is broken over two lines"
    assert found["bug"].error == f"{tmp_path}/bug.usd: ZeroDivisionError: division by zero; please report it"
    assert found["deep"].error == f"{tmp_path}/deep.usd: is nested too deeply to be read"
    assert found["good"].summary is not None and not found["good"].error
    assert {outcome.attempts for outcome in found.values()} == {1}


def test_a_job_whose_worker_dies_is_tried_once_more(tmp_path: Path):
    found = run(tmp_path, ["die", "diesonce", "good-1", "good-2"])
    assert (found["die"].error, found["die"].attempts) == (f"{tmp_path}/die.usd: the process died (SIGKILL)", 2)
    assert (found["diesonce"].error, found["diesonce"].attempts) == ("", 2)
    assert found["good-1"].summary and found["good-2"].summary


def test_a_job_that_hangs_is_stopped(tmp_path: Path):
    found = run(tmp_path, ["hang", "good"], replace(LIMITS, seconds=0.5))
    assert (found["hang"].error, found["hang"].attempts) == (f"{tmp_path}/hang.usd: stopped after 0.5 s", 2)
    assert found["good"].summary is not None


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="needs /proc")
def test_a_job_that_grows_is_stopped(tmp_path: Path):
    found = run(tmp_path, ["grow", "good"], replace(LIMITS, memory_mib=700, attempts=1))
    assert found["grow"].error == f"{tmp_path}/grow.usd: stopped at 700 MiB of memory"
    assert found["good"].summary is not None


def test_workers_that_never_get_ready_end_the_batch(tmp_path: Path):
    job = Job("a", tmp_path / "a.usd", tmp_path / "a.ttl", "https://my.lab/")
    with pytest.raises(ChildProcessError, match=r"no worker gets ready: the process died \(exit code 3\)"):
        list(run_in_processes(Unprepared(), [job], LIMITS))
