"""A store folder on a full disk: readers skip what cannot be finished, and graphs can be removed."""

import errno
import os
from pathlib import Path

import pyoxigraph as ox
import pytest

from usd2kg.errors import StoreError
from usd2kg.stores import EmbeddedStore, NamedGraph
from usd2kg.stores.named_graph import stored_quads
from usd2kg.stores.pending import PENDING_NAME, write_pending
from usd2kg.stores.store_limits import RESERVE_BYTES


def fill_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make adding a graph to the store fail as on a full disk."""

    def fail(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    for step in ("_finish", "_add"):
        monkeypatch.setattr(EmbeddedStore, step, fail)


@pytest.fixture
def store(tmp_path: Path, small: NamedGraph, other: NamedGraph) -> EmbeddedStore:
    """A store of two graphs, the load of one of which was interrupted."""
    found = EmbeddedStore(tmp_path)
    found.load(small)
    found.load(other)
    write_pending(tmp_path, ox.NamedNode(other.iri), stored_quads(NamedGraph(other.iri, other.triples[:5])))
    return found


def test_readers_skip_a_load_that_cannot_be_finished(
    store: EmbeddedStore, small: NamedGraph, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
):
    with monkeypatch.context() as full:
        fill_disk(full)
        assert small.iri in {graph.iri for graph in store.graphs()}
        assert len(store.fetch([small.iri])) == len(set(small.triples))
        assert store.query("ASK { ?s ?p ?o }", [small.iri])
    assert "No space left on device); free disk space" in caplog.text
    assert "the scene whose load was interrupted is missing until then" in caplog.text
    assert store.graphs()
    assert not Path(store.address, PENDING_NAME).exists()


def test_a_graph_is_removed_and_the_interrupted_load_given_up(
    store: EmbeddedStore,
    small: NamedGraph,
    other: NamedGraph,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
):
    fill_disk(monkeypatch)
    store.remove(small.iri)
    assert {graph.iri for graph in store.graphs()} == {other.iri}
    assert f"discarded an interrupted load; load <{other.iri}> again" in caplog.text


def test_removing_uses_the_reserve_before_it_gives_up_a_load(
    tmp_path: Path, small: NamedGraph, monkeypatch: pytest.MonkeyPatch
):
    store = EmbeddedStore(tmp_path)
    store.load(small)
    reserve = tmp_path / "usd2kg.reserve"
    assert reserve.stat().st_size == RESERVE_BYTES
    opened = EmbeddedStore._open_store

    def open_with_space(self: EmbeddedStore) -> object:
        if reserve.exists():
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return opened(self)

    monkeypatch.setattr(EmbeddedStore, "_open_store", open_with_space)
    store.remove(small.iri)
    assert not store.graphs()
    assert reserve.exists()


def test_loading_on_a_full_disk_is_an_error_that_says_what_to_do(
    tmp_path: Path, small: NamedGraph, monkeypatch: pytest.MonkeyPatch
):
    store = EmbeddedStore(tmp_path)
    with monkeypatch.context() as full:
        fill_disk(full)
        with pytest.raises(StoreError, match=r"No space left on device\); free disk space, or check the permissions"):
            store.load(small)
    assert store.graphs() == ()
    assert not (tmp_path / PENDING_NAME).exists()


def test_a_writer_deletes_what_killed_writers_left(tmp_path: Path, small: NamedGraph):
    EmbeddedStore(tmp_path).load(small)
    left = [tmp_path / name for name in (f"{PENDING_NAME}.x1", "bulk-1.sst", "LOG.old.1795779641495399")]
    for path in left:
        path.write_bytes(b"x")
    EmbeddedStore(tmp_path).check()
    assert [path for path in left if path.exists()] == []


def test_an_error_of_another_kind_gives_up_no_load(
    store: EmbeddedStore, small: NamedGraph, other: NamedGraph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    def fail(*_: object) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    with monkeypatch.context() as broken:
        broken.setattr(EmbeddedStore, "_finish", fail)
        with pytest.raises(StoreError, match="cannot be read or written"):
            store.remove(small.iri)
    assert (tmp_path / PENDING_NAME).exists()
    assert {graph.iri for graph in store.graphs()} == {small.iri, other.iri}


def test_a_short_reserve_is_written_anew(store: EmbeddedStore, small: NamedGraph, tmp_path: Path):
    reserve = tmp_path / "usd2kg.reserve"
    reserve.write_bytes(b"cut")
    store.load(small)
    assert reserve.stat().st_size == RESERVE_BYTES
