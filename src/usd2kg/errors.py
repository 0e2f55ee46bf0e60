"""The exceptions of usd2kg.

::

    Usd2kgError
    ├── SceneError        the stage cannot be read, or has no objects
    ├── OntologyError     the ontology cannot be read, or no class is in scope
    ├── GroundingError    the grounder is unknown, or its settings are invalid
    ├── EvaluationError   gold labels, a run matrix or stored results cannot be used
    ├── GraphError        the graph cannot be read, or a question cannot be answered
    ├── StoreError        a graph store is unreachable, refuses a request, or is locked by another process
    └── OutputError       a result cannot be written

Each message is one line: where, what was found, what was expected, what to do.
Other exceptions are bugs and are never wrapped.
"""

__all__ = [
    "EvaluationError",
    "GraphError",
    "GroundingError",
    "OntologyError",
    "OutputError",
    "SceneError",
    "StoreError",
    "Usd2kgError",
    "one_line",
]


class Usd2kgError(Exception):
    """Base class of all errors that a user can fix."""


class SceneError(Usd2kgError):
    """The stage cannot be opened, or has no objects."""


class OntologyError(Usd2kgError):
    """The ontology cannot be read, or has no class in scope."""


class GroundingError(Usd2kgError):
    """A grounder, regime or evidence group is unknown, or a settings file is malformed."""


class EvaluationError(Usd2kgError):
    """Gold labels, a run matrix or stored results cannot be read or do not match."""


class GraphError(Usd2kgError):
    """A graph file cannot be read, or a question cannot be answered from it."""


class StoreError(Usd2kgError):
    """A graph store is unreachable, refuses a request, or is locked by another process."""


class OutputError(Usd2kgError):
    """A result cannot be written."""


def one_line(error: object) -> str:
    """Return the text of an error without line breaks, for messages of one line.

    >>> one_line(ValueError("line 1:\\n  expected a comma"))
    'line 1: expected a comma'
    """
    return " ".join(str(error).split())
