"""The studio: a local web application to look at a scene, review its classes, and ask questions."""

from usd2kg.studio.open_session import is_graph
from usd2kg.studio.project import PROJECT_FILE, Project, ProjectSources, open_project
from usd2kg.studio.serving import serve_studio

__all__ = ["PROJECT_FILE", "Project", "ProjectSources", "is_graph", "open_project", "serve_studio"]
