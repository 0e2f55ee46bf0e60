"""What a user can choose about how a graph is written."""

from dataclasses import dataclass
from datetime import UTC, datetime

from usd2kg.errors import GraphError

__all__ = ["ANNOTATIONS", "COLORS", "GraphOptions", "read_epoch", "read_time"]

ANNOTATIONS = ("owl", "rdf12")
"""How statements are annotated: as OWL annotates axioms, or by RDF 1.2's triple terms, which OWL tools do not read."""
COLORS = ("usd", "knowrob")
"""How the soma profile writes colours: as USD.owl does, or as KnowRob asks for them, which SOMA makes inconsistent."""


@dataclass(frozen=True)
class GraphOptions:
    """How a graph is written.

    Raises:
        GraphError: an option has none of its values.
    """

    annotations: str = "owl"
    """One of `ANNOTATIONS`."""
    colors: str = "usd"
    """One of `COLORS`."""
    time: datetime | None = None
    """When the run ended, with its time zone; None leaves it out, so that the same input gives the same bytes."""

    def __post_init__(self) -> None:
        for name, value, known in (("annotations", self.annotations, ANNOTATIONS), ("colors", self.colors, COLORS)):
            if value not in known:
                raise GraphError(f"{name} {value!r} is unknown; expected one of {', '.join(known)}")


def read_time(text: str) -> datetime:
    """Return the time that a person wrote, in UTC: `now`, or ISO 8601 with a time zone.

    >>> read_time("2026-07-15T14:00:00+02:00").isoformat()
    '2026-07-15T12:00:00+00:00'

    Raises:
        GraphError: it is neither.
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
        GraphError: it is no such number.
    """
    try:
        return datetime.fromtimestamp(int(text), UTC)
    except (ValueError, OverflowError, OSError) as error:
        raise GraphError(f"SOURCE_DATE_EPOCH {text!r}: expected whole seconds since 1970; mend or unset it") from error
