"""EmbeddedStore: many scenes in one folder, asked without a server."""

import logging
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import pyoxigraph as ox

from usd2kg.errors import GraphError, StoreError
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.query.answer import Answer
from usd2kg.query.complexity import check_complexity
from usd2kg.query.graph_store import GraphStore
from usd2kg.query.remote_clauses import has_remote_clause
from usd2kg.stores.catalog import StoredGraph, list_graphs
from usd2kg.stores.folder_lock import LOCK_NAME, lock_exclusive, lock_shared
from usd2kg.stores.named_graph import NamedGraph, relabel_blank_nodes
from usd2kg.stores.pending import PENDING_NAME, read_name, set_aside_damaged, write_pending

__all__ = ["EmbeddedStore"]

logger = logging.getLogger(__name__)

_ROCKS = "CURRENT"
"""Every folder of Oxigraph has a file of this name."""
_OURS = re.compile(
    r"usd2kg\.(lock|pending|damaged).*|LOCK|LOG(\.old\.\d+)?|IDENTITY|(MANIFEST|OPTIONS)-\d+(\.dbtmp)?|\d+\.(log|sst|dbtmp)"
)
"""Names of what a store that is only begun may hold."""
_WAIT_S = 10.0


class EmbeddedStore:
    """A folder of Oxigraph's, which it can also serve itself. One writer or many readers at a time.

    Each call holds the folder only while it runs.
    """

    def __init__(self, folder: Path | str, *, wait_s: float = _WAIT_S) -> None:
        self._folder = Path(folder)
        self._wait_s = wait_s

    @property
    def address(self) -> str:
        """The folder, as the user named it."""
        return str(self._folder)

    def check(self) -> None:
        """Make the folder ready for graphs.

        Raises:
            StoreError: the folder holds other things, cannot be written to, or another process holds it.
        """
        with self._writing():
            pass

    def load(self, graph: NamedGraph) -> None:
        """Put a graph under its name, in place of what was there: all of it, or nothing, whatever happens.

        Raises:
            StoreError: as `check`, or the disk is full.
        """
        with self._writing() as store:
            try:
                write_pending(self._folder, graph.iri, relabel_blank_nodes(graph))
                self._finish(store)
            except OSError as error:
                raise StoreError(f"{self._folder}: could not be written ({_reason(error)}); free some space") from error

    def remove(self, iri: str) -> None:
        """Take a graph out.

        Raises:
            StoreError: as `check`.
        """
        with self._writing() as store:
            store.remove_graph(ox.NamedNode(iri))
            store.flush()

    def update(self, sparql: str) -> None:
        """Run a SPARQL 1.1 update, all of it or nothing; our usual prefixes need no declaration.

        Raises:
            GraphError: the update does not parse, is nested too deep, or asks for a file of another server.
            StoreError: as `check`.
        """
        check_complexity(sparql, is_update=True)
        if has_remote_clause(sparql):
            raise GraphError("update: LOAD and SERVICE ask another server, and none is asked; load a file instead")
        with self._writing() as store:
            try:
                store.update(sparql, prefixes=PREFIXES)
                store.flush()
            except SyntaxError as error:
                raise GraphError(f"update: not valid SPARQL ({_reason(error)})") from error
            except (RuntimeError, OSError) as error:
                raise GraphError(f"update: could not be done, nothing was changed ({_reason(error)})") from error

    def graphs(self) -> tuple[StoredGraph, ...]:
        """Return the graphs of scenes and ontologies in the folder."""
        return list_graphs(self.select)

    def select(self, sparql: str) -> list[dict[str, str | None]]:
        """Return the rows of a SELECT over the folder as it is."""
        check_complexity(sparql)
        with self._reading() as store:
            found = store.query(sparql)
            assert isinstance(found, ox.QuerySolutions)
            names = [variable.value for variable in found.variables]
            return [{name: row[name] and row[name].value for name in names} for row in found]

    def query(self, sparql: str, graphs: Sequence[str]) -> Answer:
        """Return the answer to a query over the union of these graphs.

        Raises:
            GraphError: the query does not parse, or updates.
            StoreError: the folder is no store, or another process writes to it.
        """
        return self.fetch(graphs).sparql(sparql)

    def fetch(self, graphs: Sequence[str]) -> GraphStore:
        """Return these graphs as one, in memory: 10 million triples need some gigabytes.

        Raises:
            StoreError: the folder is no store, or another process writes to it.
        """
        copy = ox.Store()
        with self._reading() as store:
            for iri in graphs:
                quads = store.quads_for_pattern(None, None, None, ox.NamedNode(iri))
                copy.bulk_extend(ox.Quad(quad.subject, quad.predicate, quad.object) for quad in quads)
        return GraphStore(copy, self.address)

    def snapshot(self, target: Path) -> None:
        """Write the store as it is now to a folder that does not exist yet; it does not change with this one.

        Raises:
            StoreError: the folder is no store, or another process writes to it.
        """
        with self._reading() as store:
            store.backup(str(target))

    @contextmanager
    def _writing(self) -> Iterator[ox.Store]:
        if self._folder.exists() and not self._folder.is_dir():
            raise StoreError(f"{self._folder}: is a file; expected a folder for the store")
        if self._folder.is_dir() and not self._is_store() and not self._is_empty():
            raise StoreError(f"{self._folder}: holds other things; expected a new folder or a store")
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise StoreError(f"{self._folder}: cannot be made ({error.strerror}); choose another folder") from error
        with lock_exclusive(self._folder, self._wait_s):
            for remains in self._folder.glob(f"{PENDING_NAME}.*"):
                remains.unlink()
            with self._told():
                store = self._open_store()
                if (self._folder / PENDING_NAME).exists() and not set_aside_damaged(self._folder):
                    self._finish(store)
                yield store

    @contextmanager
    def _reading(self) -> Iterator[ox.Store]:
        if not self._is_store():
            raise StoreError(
                f"{self._folder}: is no store; expected a folder that usd2kg build --store or usd2kg store load made"
            )
        if (self._folder / PENDING_NAME).exists():
            # Whoever was loading has died, or is still at it: then this waits.
            self.check()
        with lock_shared(self._folder, self._wait_s), self._told():
            try:
                store = ox.Store.read_only(str(self._folder))
            except OSError as error:
                raise StoreError(f"{self._folder}: cannot be read as a store ({_reason(error)})") from error
            yield store

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Say what to do where the files of the store turn out to be damaged, which may be at any read of them."""
        try:
            yield
        except RuntimeError as error:
            raise StoreError(
                f"{self._folder}: the store is damaged ({_reason(error)}); restore the folder from a copy, or load its "
                "scenes into a new folder"
            ) from error

    def _open_store(self) -> ox.Store:
        try:
            return ox.Store(str(self._folder))
        except OSError as error:
            if "lock" in str(error).lower():
                raise StoreError(
                    f"{self._folder}: another program holds it, like a running Oxigraph server; stop that, or give its "
                    "address with --store http://…"
                ) from error
            raise StoreError(f"{self._folder}: cannot be opened as a store ({_reason(error)})") from error

    def _is_store(self) -> bool:
        return (self._folder / _ROCKS).is_file()

    def _is_empty(self) -> bool:
        # A first load that was killed early leaves its lock, and maybe a store that is only begun.
        names = {path.name for path in self._folder.iterdir()}
        return not names or (LOCK_NAME in names and all(map(_OURS.fullmatch, names)))

    def _finish(self, store: ox.Store) -> None:
        """Put the pending graph in place; may be done again after it was broken off."""
        path = self._folder / PENDING_NAME
        with path.open("rb") as file:
            node = read_name(file)
            logger.info("%s: puts %s in place", self._folder, node)
            store.remove_graph(node)
            # Neither renames blank nodes.
            store.bulk_extend(ox.parse(file, format=ox.RdfFormat.N_QUADS))
        store.flush()
        path.unlink()


def _reason(error: BaseException) -> str:
    return " ".join(str(error).split())
