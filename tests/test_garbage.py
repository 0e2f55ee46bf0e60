"""Cyclic garbage collection is paused while allocating, and rare in a command."""

import gc
import subprocess
import sys
from collections.abc import Iterator

import pytest

from usd2kg.garbage import paused_collection, release_freed_memory


@pytest.fixture
def collector_state() -> Iterator[None]:
    was_enabled = gc.isenabled()
    gc.enable()
    gc.unfreeze()
    yield
    gc.unfreeze()
    (gc.enable if was_enabled else gc.disable)()


def is_old(allocated: object) -> bool:
    return any(one is allocated for one in gc.get_objects(generation=2))


@pytest.mark.usefixtures("collector_state")
def test_disables_collection_and_ages_new_objects():
    with paused_collection():
        assert not gc.isenabled()
        made = [[number] for number in range(10)]
        assert not is_old(made)
    assert gc.isenabled()
    assert is_old(made)
    assert gc.get_freeze_count() == 0


@pytest.mark.usefixtures("collector_state")
def test_keeps_frozen_objects_frozen():
    kept = [["a", "b"]]
    gc.freeze()
    with paused_collection():
        made = [[]]
    assert gc.get_freeze_count() > 0
    assert not is_old(kept)
    assert not is_old(made)


@pytest.mark.usefixtures("collector_state")
def test_keeps_collection_disabled_if_it_was():
    gc.disable()
    with pytest.raises(ZeroDivisionError), paused_collection():
        made = [[]]
        1 / 0  # noqa: B018
    assert not gc.isenabled()
    assert not is_old(made)


FINALIZED_CYCLE = """
import os
class Cycle:
    def __init__(self):
        self.own = self
    def __del__(self, write=os.write):
        write(1, b"finalized")
cycle = Cycle()
"""


@pytest.mark.parametrize(
    ("start", "printed"), [("", "finalized"), ("from usd2kg.garbage import collect_rarely; collect_rarely()", "")]
)
def test_a_command_does_not_collect_at_exit(start: str, printed: str):
    command = [sys.executable, "-c", start + FINALIZED_CYCLE]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout == printed


def test_releases_memory_on_any_system(monkeypatch: pytest.MonkeyPatch):
    release_freed_memory()
    monkeypatch.setattr("sys.platform", "darwin")
    release_freed_memory()
