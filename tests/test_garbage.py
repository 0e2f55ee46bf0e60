"""Python does not look for garbage while many things are made that stay, and not among them first afterwards."""

import gc
from collections.abc import Iterator

import pytest

from usd2kg.garbage import paused_collection


@pytest.fixture
def thawed() -> Iterator[None]:
    was_enabled = gc.isenabled()
    gc.enable()
    gc.unfreeze()
    yield
    gc.unfreeze()
    (gc.enable if was_enabled else gc.disable)()


def is_old(thing: object) -> bool:
    return any(one is thing for one in gc.get_objects(generation=2))


@pytest.mark.usefixtures("thawed")
def test_nothing_is_collected_meanwhile_and_what_was_made_is_old_afterwards():
    with paused_collection():
        assert not gc.isenabled()
        made = [[number] for number in range(10)]
        assert not is_old(made)
    assert gc.isenabled()
    assert is_old(made)
    assert gc.get_freeze_count() == 0


@pytest.mark.usefixtures("thawed")
def test_what_somebody_froze_stays_so():
    kept = [["a", "b"]]
    gc.freeze()
    with paused_collection():
        made = [[]]
    assert gc.get_freeze_count() > 0
    assert not is_old(kept)
    assert not is_old(made)


@pytest.mark.usefixtures("thawed")
def test_one_who_looks_for_no_garbage_is_left_alone():
    gc.disable()
    with pytest.raises(ZeroDivisionError), paused_collection():
        made = [[]]
        1 / 0  # noqa: B018
    assert not gc.isenabled()
    assert not is_old(made)
