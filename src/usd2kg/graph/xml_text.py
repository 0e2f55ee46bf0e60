"""Text in XML: escaping, and characters that XML cannot represent."""

import re
from xml.sax.saxutils import escape

__all__ = ["find_illegal_character", "replace_illegal_characters", "xml_attribute", "xml_text"]

_ILLEGAL = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that are illegal in XML 1.0, even escaped (section 2.2)."""
_RETURN = {"\r": "&#13;"}
"""XML readers normalise a bare carriage return to a line feed (section 2.11)."""


def find_illegal_character(text: str) -> str | None:
    """Return the first character that is illegal in XML, or None."""
    found = _ILLEGAL.search(text)
    return found[0] if found else None


def replace_illegal_characters(text: str) -> str:
    """Return text with U+FFFD for each character that is illegal in XML."""
    return _ILLEGAL.sub("\ufffd", text)


def xml_text(text: str) -> str:
    """Return text escaped as element content."""
    return escape(text, _RETURN)


def xml_attribute(text: str) -> str:
    """Return text escaped as a double-quoted attribute value."""
    return escape(text, {**_RETURN, '"': "&quot;", "\n": "&#10;", "\t": "&#9;"})
