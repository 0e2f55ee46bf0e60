"""EmbeddedStore: many scenes in one folder, without a server."""

import errno
import logging
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError, StoreError, one_line
from usd2kg.folder_lock import LOCK_NAME, lock_exclusive, lock_shared, release_when_unused
from usd2kg.query.answer import Answer
from usd2kg.query.complexity import check_complexity
from usd2kg.query.dataset import Dataset
from usd2kg.query.graph_cache import open_tables
from usd2kg.query.graph_store import GraphStore
from usd2kg.query.remote_clauses import REMOTE_UPDATE, has_remote_clause
from usd2kg.query.settings import CACHE
from usd2kg.stores.named_graph import NamedGraph, stored_quads
from usd2kg.stores.named_graphs import StoredGraph, list_graphs
from usd2kg.stores.pending import PENDING_NAME, read_name, set_aside_damaged, write_pending
from usd2kg.stores.replacement import replace_graph
from usd2kg.stores.reserve import keep_reserve, release_reserve
from usd2kg.stores.store_limits import FolderLimits

__all__ = ["EmbeddedStore"]

logger = logging.getLogger(__name__)

_ROCKSDB_FILE = "CURRENT"
"""A file in every Oxigraph folder."""
_LEFTOVERS = (f"{PENDING_NAME}.*", "LOG.old.*", "bulk-*.sst")
"""Stale files of killed loads and aborted bulk loads, and old logs of the engine."""
_STORE_FILES = re.compile(
    r"usd2kg\.(lock|pending|damaged|reserve).*|LOCK|LOG(\.old\.\d+)?|IDENTITY|(MANIFEST|OPTIONS)-\d+(\.dbtmp)?|\d+\.(log|sst|dbtmp)"
)
"""Names of files in an incompletely created store."""
_DATA_FILES = re.compile(r"CURRENT|MANIFEST-\d+|\d+\.(log|sst)")
"""Names of the files that change with the content of a store."""


class _UnwritableError(StoreError):
    """The folder cannot be written, as on a full disk; it may still be readable."""


class _FullDiskError(_UnwritableError):
    """The disk or the quota is full."""


class EmbeddedStore:
    """An Oxigraph folder with one writer or many readers at a time; `oxigraph serve` can serve it too.

    Each call locks the folder only while it runs.
    """

    def __init__(self, folder: Path | str, *, limits: FolderLimits | None = None) -> None:
        self._folder = Path(folder)
        self._wait_s = (limits or FolderLimits()).lock_wait_s

    @property
    def address(self) -> str:
        """The folder, as the user wrote it."""
        return str(self._folder)

    def check(self) -> None:
        """Create the folder if it is missing, and finish an interrupted load.

        Raises:
            StoreError: the folder contains other files, is not writable, or is locked by another process.
        """
        with self._writing():
            pass

    def load(self, graph: NamedGraph) -> None:
        """Add or replace a graph atomically, even if the process is killed.

        Raises:
            StoreError: as for `check`, or the disk is full.
        """
        node = ox.NamedNode(graph.iri)
        with self._writing() as store:
            if store.contains_named_graph(node):
                # Removing the old graph and adding the new one are two transactions.
                write_pending(self._folder, node, stored_quads(graph))
                self._finish(store)
            else:
                self._add(store, stored_quads(graph))
            keep_reserve(self._folder)

    def remove(self, iri: str) -> None:
        """Remove a graph.

        On a full disk, this releases the reserve of the folder and, if necessary, discards an interrupted load.

        Raises:
            StoreError: as for `check`.
        """
        for free_space in (partial(release_reserve, self._folder), self._discard_pending):
            with suppress(_FullDiskError):
                return self._remove(iri)
            free_space()
        return self._remove(iri)

    def _remove(self, iri: str) -> None:
        with self._writing() as store:
            store.remove_graph(ox.NamedNode(iri))
            store.flush()
            keep_reserve(self._folder)

    def update(self, sparql: str) -> None:
        """Run a SPARQL 1.1 update atomically; the prefixes of the package and of the graphs are predefined.

        Raises:
            GraphError: the update does not parse, is nested too deep, or contacts another server.
            StoreError: as for `check`.
        """
        check_complexity(sparql, is_update=True)
        if has_remote_clause(sparql):
            raise GraphError(REMOTE_UPDATE)
        with self._writing() as store:
            try:
                store.update(sparql, prefixes=Dataset(store).prefixes)
                store.flush()
            except SyntaxError as error:
                raise GraphError(f"update: not valid SPARQL ({one_line(error)})") from error
            except (RuntimeError, OSError) as error:
                raise GraphError(f"update: failed, nothing was changed ({one_line(error)})") from error

    def graphs(self) -> tuple[StoredGraph, ...]:
        """Return the graphs of scenes and ontologies."""
        return list_graphs(self.select)

    def select(self, sparql: str) -> list[dict[str, str | None]]:
        """Return the rows of a SELECT over all graphs."""
        check_complexity(sparql)
        with self._reading() as store:
            found = store.query(sparql)
            assert isinstance(found, ox.QuerySolutions)
            names = [variable.value for variable in found.variables]
            return [{name: row[name] and row[name].value for name in names} for row in found]

    def query(self, sparql: str, graphs: Sequence[str]) -> Answer:
        """Return the answer to a query over the union of the given graphs.

        Raises:
            GraphError: the query does not parse, is an update, is too complex, or contacts another server.
            StoreError: the folder is not a store, or another process writes to it.
        """
        return self.views([graphs])[0].sparql(sparql)

    def fetch(self, graphs: Sequence[str]) -> GraphStore:
        """Return the union of the given graphs in memory; 10 million triples need several gigabytes.

        Raises:
            StoreError: the folder is not a store, or another process writes to it.
        """
        copy = ox.Store()
        with self._reading() as store:
            for iri in graphs:
                quads = store.quads_for_pattern(None, None, None, ox.NamedNode(iri))
                copy.bulk_extend(ox.Quad(quad.subject, quad.predicate, quad.object) for quad in quads)
        return GraphStore(Dataset(copy), self.address)

    def views(self, selections: Iterable[Sequence[str]]) -> list[GraphStore]:
        """Return the union of each selection of graphs, in place; writers wait until all are no longer used.

        Raises:
            StoreError: the folder is not a store, or another process writes to it.
        """
        with ExitStack() as locks:
            store = locks.enter_context(self._reading())
            keeper = release_when_unused(locks.pop_all())
        everything = set(store.named_graphs())
        chosen = (tuple(map(ox.NamedNode, graphs)) for graphs in selections)
        selected = (None if everything <= set(graphs) else graphs for graphs in chosen)
        return [GraphStore(Dataset(store, graphs, self.tables(graphs)), self.address, keeper) for graphs in selected]

    def tables(self, graphs: Iterable[ox.NamedNode] | None = None) -> Path | None:
        """Return a folder for tables derived from the current content of some graphs; None for a small store.

        Args:
            graphs: the graphs; None for all.
        """
        files = [file.stat() for file in self._folder.iterdir() if _DATA_FILES.fullmatch(file.name)]
        if sum(state.st_size for state in files) < CACHE.min_mib * (1 << 20):
            return None
        names = None if graphs is None else sorted(str(graph) for graph in graphs)
        changes = sorted((state.st_ino, state.st_size, state.st_mtime_ns) for state in files)
        return open_tables((str(self._folder.resolve()), changes, names))

    def snapshot(self, target: Path) -> None:
        """Copy the store to a new folder.

        Raises:
            StoreError: the folder is not a store, or another process writes to it.
        """
        with self._reading() as store:
            store.backup(str(target))

    @contextmanager
    def _writing(self) -> Iterator[ox.Store]:
        if self._folder.exists() and not self._folder.is_dir():
            raise StoreError(f"{self._folder}: is a file; expected a folder for the store")
        if self._folder.is_dir() and not self._is_store() and not self._is_empty():
            raise StoreError(f"{self._folder}: contains other files; expected a new folder or a store")
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise StoreError(f"{self._folder}: cannot be created ({error.strerror}); choose another folder") from error
        with self._damage_reported(_UnwritableError), lock_exclusive(self._folder, self._wait_s):
            for leftover in [path for pattern in _LEFTOVERS for path in self._folder.glob(pattern)]:
                leftover.unlink()
            store = self._open_store()
            if (self._folder / PENDING_NAME).exists() and not set_aside_damaged(self._folder):
                logger.info("%s: finishes an interrupted load", self._folder)
                self._finish(store)
            yield store

    @contextmanager
    def _reading(self) -> Iterator[ox.Store]:
        if not self._is_store():
            raise StoreError(
                f"{self._folder}: is not a store; expected a folder that usd2kg build --store or usd2kg store load "
                "created"
            )
        if (self._folder / PENDING_NAME).exists():
            # Another process died while loading, or is still loading; the lock distinguishes the two.
            self._finish_if_possible()
        with lock_shared(self._folder, self._wait_s), self._damage_reported():
            yield ox.Store.read_only(str(self._folder))

    def _finish_if_possible(self) -> None:
        try:
            self.check()
        except _UnwritableError as error:
            # Log the text, not the exception: its traceback would keep the store open as long as the log record.
            logger.warning("%s; the scene whose load was interrupted is missing until then", str(error))

    def _discard_pending(self) -> None:
        """Delete the graph of an interrupted load."""
        path = self._folder / PENDING_NAME
        with self._damage_reported(_UnwritableError), lock_exclusive(self._folder, self._wait_s):
            if path.is_file():
                with path.open("rb") as file:
                    logger.warning("%s: discarded an interrupted load; load %s again", self._folder, read_name(file))
                path.unlink()

    @contextmanager
    def _damage_reported(self, unusable: type[StoreError] = StoreError) -> Iterator[None]:
        """Translate the engine's errors for damaged files, which any read can raise, and operating system errors."""
        try:
            yield
        except OSError as error:
            kind = _FullDiskError if unusable is _UnwritableError and _is_full(error) else unusable
            raise kind(
                f"{self._folder}: cannot be read or written ({one_line(error)}); free disk space, or check the "
                "permissions of the folder"
            ) from error
        except RuntimeError as error:
            raise StoreError(
                f"{self._folder}: the store is damaged ({one_line(error)}); restore the folder from a backup, or load "
                "its scenes into a new folder"
            ) from error

    def _open_store(self) -> ox.Store:
        try:
            return ox.Store(str(self._folder))
        except OSError as error:
            if "lock" in str(error).lower():
                raise StoreError(
                    f"{self._folder}: is in use by another program, such as an Oxigraph server; stop it, or give its "
                    "address with --store http://…"
                ) from error
            raise

    def _is_store(self) -> bool:
        return (self._folder / _ROCKSDB_FILE).is_file()

    def _is_empty(self) -> bool:
        # An early kill of the first load leaves the lock, and possibly an incompletely created store.
        names = {path.name for path in self._folder.iterdir()}
        return not names or (LOCK_NAME in names and all(map(_STORE_FILES.fullmatch, names)))

    def _add(self, store: ox.Store, quads: Iterable[ox.Quad]) -> None:
        """Add all quads to the store, or none if the process dies."""
        # The engine adds them atomically. Its documentation does not guarantee this, so a test kills it at many points.
        store.bulk_extend(quads)
        store.flush()

    def _finish(self, store: ox.Store) -> None:
        """Move the pending graph into the store and delete its file; idempotent."""
        replace_graph(store, self._folder / PENDING_NAME)
        (self._folder / PENDING_NAME).unlink()


def _is_full(error: OSError) -> bool:
    """Return whether the disk or a quota is full; the engine reports this only in the message text."""
    text = str(error).lower()
    return error.errno in {errno.ENOSPC, errno.EDQUOT} or "no space left" in text or "quota" in text
