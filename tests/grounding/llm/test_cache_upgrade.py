"""Upgrade of a completion cache of format 1."""

import sqlite3
import threading
from pathlib import Path

import pytest

from tests.grounding.llm.completions import COMPLETION, MODEL, OLD_COMPLETION, REQUEST, UPGRADED, request_about
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.serialization import request_key


def _downgrade(path: Path, count: int) -> None:
    """Create a cache of format 1 with `count` completions."""
    with CompletionCache(path) as cache:
        for i in range(count):
            cache.put(MODEL, request_about(i), COMPLETION)
    connection = sqlite3.connect(path)
    with connection:
        connection.execute("UPDATE completions SET completion = ?", (OLD_COMPLETION,))
        connection.execute("PRAGMA user_version = 1")
    connection.close()


def test_keeps_the_completions(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    _downgrade(path, 3)
    for _ in range(2):
        with CompletionCache(path) as cache:
            assert len(cache) == 3
            assert [cache.get(MODEL, request_about(i)) for i in range(3)] == [UPGRADED] * 3
            cache.put(MODEL, REQUEST, COMPLETION)
            assert cache.get(MODEL, REQUEST) == COMPLETION
            path = cache.path
        _delete(path, REQUEST)
    connection = sqlite3.connect(path)
    assert connection.execute("PRAGMA user_version").fetchone() == (2,)
    connection.close()


def _delete(path: Path, request: Request) -> None:
    connection = sqlite3.connect(path)
    with connection:
        connection.execute("DELETE FROM completions WHERE key = ?", (request_key(MODEL, request),))
    connection.close()


def test_threads_can_upgrade_simultaneously(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    _downgrade(path, 50)
    found: list[Completion | None] = []

    def read() -> None:
        with CompletionCache(path) as cache:
            found.extend(cache.get(MODEL, request_about(i)) for i in range(50))

    threads = [threading.Thread(target=read) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [UPGRADED] * 300


def test_leaves_a_damaged_completion_unchanged(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    _downgrade(path, 2)
    connection = sqlite3.connect(path)
    with connection:
        connection.execute(
            "UPDATE completions SET completion = '{' WHERE key = ?", (request_key(MODEL, request_about(0)),)
        )
    connection.close()
    with CompletionCache(path) as cache:
        assert cache.get(MODEL, request_about(1)) == UPGRADED
        with pytest.raises(GroundingError, match="is damaged"):
            cache.get(MODEL, request_about(0))
