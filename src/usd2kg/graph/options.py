"""User options of graph construction."""

from dataclasses import dataclass
from datetime import UTC, datetime

from usd2kg.errors import GraphError

__all__ = ["ANNOTATIONS", "COLORS", "GraphOptions", "read_epoch", "read_time"]

ANNOTATIONS = ("owl", "rdf12")
"""OWL 2 axiom annotations, or RDF 1.2 reifiers, which OWL tools do not read."""
COLORS = ("usd", "knowrob")
"""Colours of the soma profile: USD.owl qualities, or SOMA qualities for KnowRob, which make the graph inconsistent."""


@dataclass(frozen=True)
class GraphOptions:
    """Annotations, colours and time stamp of a graph.

    Raises:
        GraphError: an option has an unknown value.
    """

    annotations: str = "owl"
    """One of `ANNOTATIONS`."""
    colors: str = "usd"
    """One of `COLORS`."""
    time: datetime | None = None
    """End of the run, with time zone; None omits it, which keeps the output reproducible."""

    def __post_init__(self) -> None:
        for name, value, known in (("annotations", self.annotations, ANNOTATIONS), ("colors", self.colors, COLORS)):
            if value not in known:
                raise GraphError(f"{name} {value!r} is unknown; expected one of {', '.join(known)}")


def read_time(text: str) -> datetime:
    """Return the UTC time for `now` or for ISO 8601 with a time zone.

    >>> read_time("2026-07-15T14:00:00+02:00").isoformat()
    '2026-07-15T12:00:00+00:00'

    Raises:
        GraphError: the text is neither.
    """
    if text == "now":
        return datetime.now(UTC).replace(microsecond=0)
    try:
        time = datetime.fromisoformat(text)
        if time.tzinfo is None:
            raise ValueError("no time zone")
        return time.astimezone(UTC)
    except (ValueError, OverflowError) as error:
        raise GraphError(f"time {text!r}: {error}; expected now, or one like 2026-07-15T12:00:00Z") from error


def read_epoch(text: str) -> datetime:
    """Return the time of SOURCE_DATE_EPOCH, whole seconds since 1970 (reproducible-builds.org).

    Raises:
        GraphError: the text is not a number in range.
    """
    try:
        return datetime.fromtimestamp(int(text), UTC)
    except (ValueError, OverflowError, OSError) as error:
        raise GraphError(
            f"SOURCE_DATE_EPOCH {text!r}: expected whole seconds since 1970; correct or unset it"
        ) from error
