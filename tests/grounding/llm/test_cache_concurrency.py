"""The completion cache shared by threads and processes, one of them killed."""

import multiprocessing
import signal
import sqlite3
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import pytest

from tests.grounding.llm.completions import COMPLETION, MODEL, REQUEST, request_about
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.limits import LIMITS


@pytest.fixture
def cache(tmp_path: Path):
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        yield cache


SPAWN = multiprocessing.get_context("spawn")


def _put_many(path: Path, name: str, start: threading.Event) -> None:
    start.wait(30)
    with CompletionCache(path) as cache:
        for i in range(100):
            cache.put(MODEL, request_about(i), Completion(f"shared {i}"))
            cache.put(name, request_about(i), Completion(f"{name} {i}"))
            assert cache.get(name, request_about(i)) == Completion(f"{name} {i}")


def test_processes_share_a_new_cache(tmp_path: Path):
    path, start = tmp_path / "cache.sqlite", SPAWN.Event()
    names = ["one", "two", "three"]
    processes = [SPAWN.Process(target=_put_many, args=(path, name, start)) for name in names]
    for process in processes:
        process.start()
    start.set()
    for process in processes:
        process.join(60)
    assert [process.exitcode for process in processes] == [0, 0, 0]
    with CompletionCache(path) as cache:
        assert len(cache) == 400
        for i in range(100):
            assert cache.get(MODEL, request_about(i)) == Completion(f"shared {i}")
            assert [cache.get(name, request_about(i)) for name in names] == [
                Completion(f"{name} {i}") for name in names
            ]


def _open_many(folder: Path, name: str, barrier: threading.Barrier) -> None:
    for i in range(40):
        barrier.wait(30)
        with CompletionCache(folder / f"{i}.sqlite") as cache:
            cache.put(name, REQUEST, COMPLETION)


def test_processes_can_create_the_same_file_simultaneously(tmp_path: Path):
    barrier = SPAWN.Barrier(4)
    processes = [SPAWN.Process(target=_open_many, args=(tmp_path, name, barrier)) for name in "abcd"]
    for process in processes:
        process.start()
    for process in processes:
        process.join(60)
    assert [process.exitcode for process in processes] == [0, 0, 0, 0]
    for path in tmp_path.glob("*.sqlite"):
        with CompletionCache(path) as cache:
            assert len(cache) == 4


def test_threads_share_an_instance(cache):
    def put(name: str) -> None:
        for i in range(50):
            cache.put(name, request_about(i), Completion(f"{name} {i}"))

    threads = [threading.Thread(target=put, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(cache) == 200
    assert cache.get("d", request_about(49)) == Completion("d 49")


def test_threads_can_create_the_same_file_simultaneously(tmp_path: Path):
    def put(name: str) -> None:
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            cache.put(name, REQUEST, COMPLETION)

    threads = [threading.Thread(target=put, args=(name,)) for name in "abcdefgh"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        assert len(cache) == 8


_PUTTER = """
import sys
from pathlib import Path
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Completion, Request
cache = CompletionCache(Path(sys.argv[1]))
for i in range(100_000):
    cache.put("m", Request("s", str(i), {}), Completion("x" * 5000 + str(i)))
    print(i, flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL")
@pytest.mark.parametrize("after", [1, 37, 150])
def test_a_killed_process_loses_no_completed_put(tmp_path: Path, after: int):
    path = tmp_path / "cache.sqlite"
    process = subprocess.Popen([sys.executable, "-c", _PUTTER, str(path)], stdout=subprocess.PIPE, text=True)
    for _ in range(after):
        process.stdout.readline()
    process.send_signal(signal.SIGKILL)
    rest, _ = process.communicate()
    assert process.returncode == -signal.SIGKILL
    returned = after + rest.count("\n")
    with CompletionCache(path) as cache:
        assert returned <= len(cache) <= returned + 1
        for i in range(returned):
            assert cache.get("m", Request("s", str(i), {})) == Completion("x" * 5000 + str(i))
        cache.put(MODEL, REQUEST, COMPLETION)
    connection = sqlite3.connect(path)
    assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    connection.close()


def test_reports_a_cache_that_stays_locked(tmp_path: Path, monkeypatch):
    monkeypatch.setattr("usd2kg.grounding.llm.cache.LIMITS", replace(LIMITS, cache_busy_s=0.05))
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        other = sqlite3.connect(cache.path, isolation_level=None)
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(
            GroundingError, match=r"cache\.sqlite: .*database is locked.*end other programs that use it"
        ):
            cache.put(MODEL, REQUEST, COMPLETION)
        other.execute("ROLLBACK")
        other.close()
        cache.put(MODEL, REQUEST, COMPLETION)
        assert cache.get(MODEL, REQUEST) == COMPLETION
