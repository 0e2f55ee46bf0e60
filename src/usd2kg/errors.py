"""The exceptions that usd2kg raises on purpose.

::

    Usd2kgError
    ├── SceneError        the stage cannot be read, or holds no object
    ├── OntologyError     the ontology cannot be read, or no class is in scope
    ├── GroundingError    the grounder is unknown or its settings are wrong
    ├── EvaluationError   gold labels, a matrix or stored results cannot be used
    ├── GraphError        the graph cannot be read, or a question cannot be understood
    ├── StoreError        a store of graphs is out of reach, refuses, or is held by another process
    └── OutputError       a result cannot be written

Each message says where, what was found, what was expected and what to do, in one line.
Bugs of our own are never wrapped: they pass through as they are.
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
]


class Usd2kgError(Exception):
    """Base of all errors that a user can mend."""


class SceneError(Usd2kgError):
    """The stage cannot be opened, or no object was found on it."""


class OntologyError(Usd2kgError):
    """The ontology cannot be read or places no class in the scope."""


class GroundingError(Usd2kgError):
    """A grounder, regime or evidence group is unknown, or a settings file is malformed."""


class EvaluationError(Usd2kgError):
    """Gold labels, a matrix of runs or stored results cannot be read or do not fit together."""


class GraphError(Usd2kgError):
    """A graph file cannot be read, or a question cannot be answered from it."""


class StoreError(Usd2kgError):
    """A store of graphs cannot be reached or opened, refuses what is asked, or is held by another process."""


class OutputError(Usd2kgError):
    """A result cannot be written where the user wants it."""
