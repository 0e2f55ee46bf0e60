"""parse_encodings: encodings of labels by their user-facing names."""

from usd2kg.errors import OutputError
from usd2kg.scene.model import Encoding

__all__ = ["parse_encodings"]

_ENCODINGS: dict[str, Encoding] = {"semantics": "UsdSemantics", "isaac": "Isaac", "multiverse": "Multiverse"}


def parse_encodings(text: str, setting: str) -> tuple[Encoding, ...]:
    """Return the encodings in a comma-separated list of names, each once.

    >>> parse_encodings("semantics, isaac", "--encoding")
    ('UsdSemantics', 'Isaac')

    Args:
        text: the list.
        setting: name of the option or setting, for the error message.

    Raises:
        OutputError: a name is unknown, or there is none.
    """
    wanted = [name.strip().lower() for name in text.split(",") if name.strip()]
    if not wanted or not _ENCODINGS.keys() >= set(wanted):
        raise OutputError(f"{setting} {text}: expected a comma-separated list of {', '.join(_ENCODINGS)}")
    return tuple(_ENCODINGS[name] for name in dict.fromkeys(wanted))
