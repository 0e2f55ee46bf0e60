"""negotiate: choose the media type of a response from the Accept header (RFC 9110, section 12.5.1)."""

from collections.abc import Sequence

__all__ = ["negotiate"]


def negotiate(accept: str | None, offered: Sequence[str]) -> str | None:
    """Return the offered media type that the client prefers, the first among equals; None if it accepts none.

    >>> negotiate("text/csv;q=0.5, application/*", ("text/csv", "application/json"))
    'application/json'
    >>> negotiate(None, ("text/csv", "application/json"))
    'text/csv'
    """
    if accept is None or not accept.strip():
        return offered[0]
    weights = _parse(accept)
    weighted = [(_weight(media_type, weights), -rank, media_type) for rank, media_type in enumerate(offered)]
    weight, _, best = max(weighted)
    return best if weight > 0 else None


def _parse(accept: str) -> dict[str, float]:
    weights = {}
    for part in accept.lower().split(","):
        media_range, *parameters = (piece.strip() for piece in part.split(";"))
        weight = next((p[2:] for p in parameters if p.startswith("q=")), "1")
        try:
            weights[media_range] = min(1.0, max(0.0, float(weight)))
        except ValueError:
            weights[media_range] = 0.0
    return weights


def _weight(media_type: str, weights: dict[str, float]) -> float:
    """Return the weight of the most specific range that covers a media type."""
    for media_range in (media_type, f"{media_type.partition('/')[0]}/*", "*/*"):
        if media_range in weights:
            return weights[media_range]
    return 0.0
