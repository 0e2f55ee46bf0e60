"""OutputFiles: the graph, the mapping and the labels in the project folder, which follow the decisions."""

import logging
import threading
from collections.abc import Callable
from pathlib import Path

from usd2kg.errors import Usd2kgError
from usd2kg.files import write_whole
from usd2kg.graph import write_graph
from usd2kg.grounding import Grounding
from usd2kg.studio.exports import EXPORTS, write_label_layer
from usd2kg.studio.session import StudioSession
from usd2kg.studio.settings import SERVER

__all__ = ["OutputFiles"]

logger = logging.getLogger(__name__)


class OutputFiles:
    """Writes the files in a thread, a moment after the last of several decisions."""

    def __init__(self, session: StudioSession, when_written: Callable[[], None]) -> None:
        """`when_written` is called in the thread after the files were written."""
        self._session = session
        self._when_written = when_written
        self._changed = threading.Event()
        self._is_closing = False
        self._written: tuple[int, Grounding] | None = None
        """Version and suggestions of the files."""
        self.problem = ""
        """Why the files are not up to date; empty if they are, or will be in a moment."""
        self._thread = threading.Thread(target=self._run, name="usd2kg-outputs", daemon=True)
        self._thread.start()

    @property
    def folder(self) -> Path:
        """The project folder."""
        return self._session.project.folder

    def notify(self) -> None:
        """Ask for the files to be written."""
        self._changed.set()

    def close(self) -> None:
        """Write what is open, and stop."""
        self._is_closing = True
        self._changed.set()
        self._thread.join()

    def _run(self) -> None:
        is_last = False
        while not is_last:
            self._changed.wait()
            is_last = self._is_closing
            while not is_last and self._changed.is_set():
                # Reviewers decide once a second; the files follow when they pause.
                self._changed.clear()
                is_last = self._is_closing or (self._changed.wait(SERVER.outputs_delay_s) and self._is_closing)
            if not self._is_current():
                self._write()

    def _is_current(self) -> bool:
        """Return whether the files are up to date."""
        if self._written is None:
            return False
        version, suggestions = self._written
        return version == self._session.version and suggestions is self._session.suggestions

    def _write(self) -> None:
        current = self._session.version, self._session.suggestions
        steps: list[Callable[[], object]] = [
            self._session.answers,
            lambda: write_graph(self._session.graph(), self.folder / "graph.ttl"),
            lambda: self._export("mapping.sssom.tsv"),
            lambda: self._export("grounding.json"),
            lambda: self._export("lessons.sssom.tsv"),
            lambda: self._export("proposals.ttl"),
        ]
        if self._session.stage is not None:
            steps.append(lambda: write_label_layer(self._session, self.folder / "labels.usda", is_bare=False))
        self.problem = ""
        for step in steps:
            try:
                step()
            except Usd2kgError as error:
                # The decisions are in the journal; one file that cannot be written stops no other.
                self.problem = str(error)
                logger.warning("%s", error)
        self._written = current
        self._when_written()

    def _export(self, name: str) -> None:
        write_whole(self.folder / name, EXPORTS[name].write(self._session))
