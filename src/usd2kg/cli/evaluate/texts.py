"""How figures and classes of an evaluation are printed."""

__all__ = ["number_text", "short_name"]


def number_text(value: float | None, form: str) -> str | None:
    """Return a number in a form; None stays None."""
    return None if value is None else format(value, form)


def short_name(iri: str | None) -> str | None:
    """Return what an IRI ends in; None stays None."""
    return iri.replace("#", "/").rpartition("/")[2] if iri else None
