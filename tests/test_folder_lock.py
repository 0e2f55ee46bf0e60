"""Tests of the lock on a folder."""

from contextlib import ExitStack
from pathlib import Path
from threading import Thread

from usd2kg.folder_lock import lock_exclusive, lock_shared, release_when_unused


def test_a_shared_lock_is_released_when_another_thread_collects_its_keeper(tmp_path: Path) -> None:
    with lock_exclusive(tmp_path, 1.0):
        pass
    locks = ExitStack()
    locks.enter_context(lock_shared(tmp_path, 1.0))
    keepers = [release_when_unused(locks)]
    collector = Thread(target=keepers.clear)
    collector.start()
    collector.join()
    with lock_exclusive(tmp_path, 0.0):
        pass
