"""XML entities, refused where what they stand for grows out of bounds ("billion laughs").

Ontologies declare entities for their namespaces, each a short text without references; parsers replace them without a
limit, so that a kilobyte may become many gigabytes.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Mapping
from typing import BinaryIO, NamedTuple

__all__ = ["refuse_entity_bomb", "refuse_entity_bomb_in_file"]

_LONGEST = 10_000
"""Characters that one entity may stand for."""
_DEEPEST = 5
"""How many entities may be within each other."""
_MOST_GROWTH = 100
"""How many times its own length a document may become by its entities…"""
_SMALL = 8_000_000
"""…if they come to more characters than these."""
_MOST_BYTES = 200_000_000
"""Of a file that declares entities."""
_CHUNK = 1 << 20
_START = b"<!ENTITY"
# Looser than XML, as parsers are. The value is not consumed: what looks like one in a comment must hide no other.
_DECLARATION = re.compile(
    r"""<!ENTITY\s*(?:%\s*)?([^\s<]+)\s+"""
    rf"""(?="([^"]{{0,{_LONGEST + 1}}})|'([^']{{0,{_LONGEST + 1}}}))"""
)
_REFERENCE = re.compile(r"[&%]([^\s;&%<]+);")
# Written so in a value, the sign begins a reference when the entity is used (XML 1.0, appendix D).
_AMPERSAND = re.compile(r"&#(?:0*38|[xX]0*26);")


class _Size(NamedTuple):
    characters: int
    depth: int
    """How many entities are within each other, itself counted."""


def refuse_entity_bomb(text: str) -> None:
    """Raise SyntaxError if the entities that an XML document declares expand beyond what an ontology needs.

    Refused are an entity of more than 10,000 characters, references within each other more than 5 deep or in a
    circle, and a document that its entities make more than 100 times as long and more than 8 million characters.
    """
    values: dict[str, list[str]] = defaultdict(list)
    for declared in _DECLARATION.finditer(text):
        name, value = declared[1], declared[2] or declared[3] or ""
        if len(value) > _LONGEST:
            raise _too_long(name)
        values[name].append(_AMPERSAND.sub("&", value))
    if not values:
        return
    sizes: dict[str, _Size] = {}
    for name in values:
        _measure(name, values, sizes, 1)
    used = Counter(found[1] for found in _REFERENCE.finditer(text))
    total = sum(size.characters * used[name] for name, size in sizes.items())
    if total > max(_SMALL, _MOST_GROWTH * len(text)):
        raise SyntaxError(
            f"its XML entities expand to {total:,} characters, expected at most {_MOST_GROWTH} times its own length"
        )


def _measure(name: str, values: Mapping[str, list[str]], sizes: dict[str, _Size], level: int) -> _Size:
    """Return the size of an entity; of the largest, where it is declared more than once."""
    if level > _DEEPEST:
        raise _too_deep(name)
    if name not in sizes:
        found = [_expand(value, values, sizes, level) for value in values[name]]
        sizes[name] = _Size(max(size.characters for size in found), max(size.depth for size in found))
    if sizes[name].characters > _LONGEST:
        raise _too_long(name)
    if level + sizes[name].depth - 1 > _DEEPEST:
        raise _too_deep(name)
    return sizes[name]


def _expand(value: str, values: Mapping[str, list[str]], sizes: dict[str, _Size], level: int) -> _Size:
    used = Counter(name for name in _REFERENCE.findall(value) if name in values)
    inner = {name: _measure(name, values, sizes, level + 1) for name in used}
    grown = sum((inner[name].characters - len(f"&{name};")) * count for name, count in used.items())
    return _Size(len(value) + grown, 1 + max((size.depth for size in inner.values()), default=0))


def _too_long(name: str) -> SyntaxError:
    return SyntaxError(f"its XML entity {name!r} stands for more than {_LONGEST:,} characters, expected a short text")


def _too_deep(name: str) -> SyntaxError:
    return SyntaxError(f"its XML entities, {name!r} among them, are more than {_DEEPEST} deep within each other")


def refuse_entity_bomb_in_file(file: BinaryIO) -> None:
    """Do the same for an open file of RDF/XML, which is read from where it stands.

    Raises:
        SyntaxError: as `refuse_entity_bomb`; or it declares entities and is longer than 200 million bytes.
        OSError, EOFError, zlib.error: it cannot be read.
    """
    end = b""
    while chunk := file.read(_CHUNK):
        if _START in end + chunk:
            file.seek(0)
            data = file.read(_MOST_BYTES + 1)
            if len(data) > _MOST_BYTES:
                raise SyntaxError(f"it declares XML entities and is longer than {_MOST_BYTES:,} bytes")
            refuse_entity_bomb(data.decode("utf-8", errors="replace"))
            return
        end = chunk[-len(_START) :]
