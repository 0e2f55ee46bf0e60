"""Numbers and class names of an evaluation as text."""

__all__ = ["number_text", "short_name"]


def number_text(value: float | None, form: str) -> str | None:
    """Return a number in a format specification; None for None."""
    return None if value is None else format(value, form)


def short_name(iri: str | None) -> str | None:
    """Return the last part of an IRI; None for None or the empty string.

    >>> short_name("http://www.ease-crc.org/ont/SOMA.owl#Cup")
    'Cup'
    """
    return iri.replace("#", "/").rpartition("/")[2] if iri else None
