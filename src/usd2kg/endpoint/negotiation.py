"""negotiate: which media type to answer in, by what a client accepts (RFC 9110, section 12.5.1)."""

from collections.abc import Sequence

__all__ = ["negotiate"]


def negotiate(accept: str | None, offered: Sequence[str]) -> str | None:
    """Return the offered media type that a client likes best, the first of equals; None if it accepts none.

    >>> negotiate("text/csv;q=0.5, application/*", ("text/csv", "application/json"))
    'application/json'
    >>> negotiate(None, ("text/csv", "application/json"))
    'text/csv'
    """
    if accept is None or not accept.strip():
        return offered[0]
    liked = _parse(accept)
    weighed = [(_weight(media_type, liked), -place, media_type) for place, media_type in enumerate(offered)]
    weight, _, best = max(weighed)
    return best if weight > 0 else None


def _parse(accept: str) -> dict[str, float]:
    liked = {}
    for part in accept.lower().split(","):
        media_range, *parameters = (piece.strip() for piece in part.split(";"))
        weight = next((p[2:] for p in parameters if p.startswith("q=")), "1")
        try:
            liked[media_range] = min(1.0, max(0.0, float(weight)))
        except ValueError:
            liked[media_range] = 0.0
    return liked


def _weight(media_type: str, liked: dict[str, float]) -> float:
    """Return the weight of the most specific range that covers a media type."""
    for media_range in (media_type, f"{media_type.partition('/')[0]}/*", "*/*"):
        if media_range in liked:
            return liked[media_range]
    return 0.0
