"""open_session: the session of a project, about a stage or a graph."""

from pathlib import Path

from usd2kg.graph import RDF_FORMATS
from usd2kg.studio.graph_session import open_graph_session
from usd2kg.studio.project import Project
from usd2kg.studio.session import StudioSession, open_stage_session

__all__ = ["is_graph", "open_session"]


def open_session(project: Project) -> StudioSession:
    """Open the stage or graph of a project.

    Raises:
        Usd2kgError: a source cannot be read.
    """
    return open_graph_session(project) if is_graph(project.sources.scene) else open_stage_session(project)


def is_graph(path: Path) -> bool:
    """Return whether a file is a graph, by its suffix."""
    name = path.with_suffix("") if path.suffix.lower() == ".gz" else path
    return name.suffix.lower() in RDF_FORMATS
