"""`compute_in_halves` gives the result of one process, whatever happens to the second."""

import os
import signal
import threading
import warnings
from collections.abc import Sequence
from itertools import chain

import pytest

from tests.kitchen import kitchen_graph, kitchen_scene
from usd2kg import build
from usd2kg.graph import abox
from usd2kg.relations import boxed_objects, pair_blocks
from usd2kg.two_processes import compute_in_halves


def squares(numbers: Sequence[int]) -> list[int]:
    return [number**2 for number in numbers]


def processes(numbers: Sequence[int]) -> tuple[int, int]:
    return os.getpid(), len(numbers)


@pytest.fixture(autouse=True)
def two_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0, 1}, raising=False)


needs_fork = pytest.mark.skipif(os.uname().sysname != "Linux", reason="other systems do not fork safely")


def test_the_halves_are_in_order():
    assert list(chain(*compute_in_halves(squares, range(7), least=2))) == squares(range(7))


@needs_fork
def test_the_second_half_has_a_process_of_its_own():
    (first, one), (second, other) = compute_in_halves(processes, range(7), least=7)
    assert first == os.getpid() != second
    assert (one, other) == (3, 4)


def test_a_short_sequence_has_one_process():
    assert compute_in_halves(processes, range(6), least=7) == [(os.getpid(), 6)]


def test_one_processor_has_one_process(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {0}, raising=False)
    assert compute_in_halves(processes, range(9), least=2) == [(os.getpid(), 9)]


def test_another_thread_does_not_fork():
    found: list[list[tuple[int, int]]] = []
    thread = threading.Thread(target=lambda: found.append(compute_in_halves(processes, range(9), least=2)))
    thread.start()
    thread.join()
    assert found == [[(os.getpid(), 9)]]


@needs_fork
def test_the_half_of_a_killed_process_is_computed_again():
    parent = os.getpid()

    def dies(numbers: Sequence[int]) -> list[int]:
        if os.getpid() != parent:
            os.kill(os.getpid(), signal.SIGKILL)
        return squares(numbers)

    assert list(chain(*compute_in_halves(dies, range(9), least=2))) == squares(range(9))


@needs_fork
def test_an_error_of_the_second_half_is_raised():
    def fails(numbers: Sequence[int]) -> list[int]:
        return [1 // (8 - number) for number in numbers]

    with pytest.raises(ZeroDivisionError):
        compute_in_halves(fails, range(9), least=2)


@needs_fork
def test_an_error_of_the_first_half_ends_the_second_process(monkeypatch: pytest.MonkeyPatch):
    killed: list[int] = []
    kill = os.kill
    monkeypatch.setattr(os, "kill", lambda pid, number: (killed.append(pid), kill(pid, number)))

    def fails(numbers: Sequence[int]) -> list[int]:
        return [1 // number for number in numbers]

    with pytest.raises(ZeroDivisionError):
        compute_in_halves(fails, range(9), least=2)
    assert len(killed) == 1
    with pytest.raises(ChildProcessError):
        os.waitpid(killed[0], 0)


@needs_fork
def test_a_large_result_does_not_block():
    assert compute_in_halves(lambda numbers: b"x" * (1 << 22), range(9), least=2) == [b"x" * (1 << 22)] * 2


@needs_fork
def test_other_threads_cause_no_warning():
    waiting = threading.Event()
    thread = threading.Thread(target=waiting.wait)
    thread.start()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert list(chain(*compute_in_halves(squares, range(9), least=2))) == squares(range(9))
    waiting.set()
    thread.join()


def test_a_graph_is_the_same_with_one_or_two_processes(monkeypatch: pytest.MonkeyPatch):
    for module, name in ((abox, "_MANY_OBJECTS"), (boxed_objects, "_MANY_SURFACES"), (pair_blocks, "_MANY_BLOCKS")):
        monkeypatch.setattr(module, name, 1)
    assert build(kitchen_scene()).graph == kitchen_graph()
