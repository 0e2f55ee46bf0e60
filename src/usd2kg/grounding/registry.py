"""The grounders by name."""

from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.base import Grounder

__all__ = ["GROUNDERS", "make_grounder"]

GROUNDERS = ("embedded", "dictionary")
"""Names that `make_grounder` knows; the first is the default."""


def make_grounder(name: str, *, dictionary: Path | None = None) -> Grounder:
    """Return the grounder of that name.

    Args:
        name: one of `GROUNDERS`.
        dictionary: for `dictionary`, a CSV file `name,class` of the user's own.

    Raises:
        GroundingError: there is no such grounder, or its file cannot be read.
    """
    # Each is imported only when it is asked for: the embedded one reads a noun taxonomy.
    if name == "embedded":
        from usd2kg.grounding.embedded.grounder import EmbeddedGrounder  # noqa: PLC0415

        return EmbeddedGrounder()
    if name == "dictionary":
        from usd2kg.grounding.dictionary import DictionaryGrounder  # noqa: PLC0415

        return DictionaryGrounder.from_csv(dictionary) if dictionary else DictionaryGrounder.multiverse()
    raise GroundingError(f"grounder {name!r} is unknown; expected one of {', '.join(GROUNDERS)}")
