"""Protection against XML entity expansion attacks ("billion laughs").

Ontologies declare entities for namespaces, each a short text without references. Parsers expand entities without a
limit, so a kilobyte may become many gigabytes.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Mapping
from typing import BinaryIO, NamedTuple

from usd2kg.ontology.limits import XML_ENTITIES

__all__ = ["refuse_entity_bomb", "refuse_entity_bomb_in_file"]

_CHUNK = 1 << 20
_START = b"<!ENTITY"
# As lenient as parsers are. The value is a lookahead, so that text in a comment cannot hide a declaration.
_DECLARATION = re.compile(
    r"""<!ENTITY\s*(?:%\s*)?([^\s<]+)\s+"""
    rf"""(?="([^"]{{0,{XML_ENTITIES.characters + 1}}})|'([^']{{0,{XML_ENTITIES.characters + 1}}}))"""
)
_REFERENCE = re.compile(r"[&%]([^\s;&%<]+);")
# In a value, an escaped ampersand starts a reference on expansion (XML 1.0, appendix D).
_AMPERSAND = re.compile(r"&#(?:0*38|[xX]0*26);")


class _Size(NamedTuple):
    characters: int
    depth: int
    """Nesting depth; 1 for an entity without references."""


def refuse_entity_bomb(text: str) -> None:
    """Raise SyntaxError if the entities of an XML document expand beyond what an ontology needs.

    `EntityLimits` documents the limits. Cyclic references exceed the nesting depth.
    """
    values: dict[str, list[str]] = defaultdict(list)
    for declared in _DECLARATION.finditer(text):
        name, value = declared[1], declared[2] or declared[3] or ""
        if len(value) > XML_ENTITIES.characters:
            raise _too_long(name)
        values[name].append(_AMPERSAND.sub("&", value))
    if not values:
        return
    sizes: dict[str, _Size] = {}
    for name in values:
        _measure(name, values, sizes, 1)
    used = Counter(found[1] for found in _REFERENCE.finditer(text))
    total = sum(size.characters * used[name] for name, size in sizes.items())
    if total > max(XML_ENTITIES.small_document, XML_ENTITIES.growth * len(text)):
        raise SyntaxError(
            f"its XML entities expand to {total:,} characters, "
            f"expected at most {XML_ENTITIES.growth} times its own length"
        )


def _measure(name: str, values: Mapping[str, list[str]], sizes: dict[str, _Size], level: int) -> _Size:
    """Return the expanded size of an entity; the largest if it is declared more than once."""
    if level > XML_ENTITIES.depth:
        raise _too_deep(name)
    if name not in sizes:
        found = [_expand(value, values, sizes, level) for value in values[name]]
        sizes[name] = _Size(max(size.characters for size in found), max(size.depth for size in found))
    if sizes[name].characters > XML_ENTITIES.characters:
        raise _too_long(name)
    if level + sizes[name].depth - 1 > XML_ENTITIES.depth:
        raise _too_deep(name)
    return sizes[name]


def _expand(value: str, values: Mapping[str, list[str]], sizes: dict[str, _Size], level: int) -> _Size:
    used = Counter(name for name in _REFERENCE.findall(value) if name in values)
    inner = {name: _measure(name, values, sizes, level + 1) for name in used}
    grown = sum((inner[name].characters - len(f"&{name};")) * count for name, count in used.items())
    return _Size(len(value) + grown, 1 + max((size.depth for size in inner.values()), default=0))


def _too_long(name: str) -> SyntaxError:
    return SyntaxError(
        f"its XML entity {name!r} expands to more than {XML_ENTITIES.characters:,} characters; expected a short text"
    )


def _too_deep(name: str) -> SyntaxError:
    return SyntaxError(f"its XML entities, {name!r} among them, are nested more than {XML_ENTITIES.depth} deep")


def refuse_entity_bomb_in_file(file: BinaryIO) -> None:
    """Apply `refuse_entity_bomb` to an open RDF/XML file, from its current position.

    Raises:
        SyntaxError: as `refuse_entity_bomb`; or it declares entities and is longer than `EntityLimits.file_bytes`.
        OSError, EOFError, zlib.error: it cannot be read.
    """
    end = b""
    while chunk := file.read(_CHUNK):
        if _START in end + chunk:
            file.seek(0)
            data = file.read(XML_ENTITIES.file_bytes + 1)
            if len(data) > XML_ENTITIES.file_bytes:
                raise SyntaxError(f"it declares XML entities and is longer than {XML_ENTITIES.file_bytes:,} bytes")
            refuse_entity_bomb(data.decode("utf-8", errors="replace"))
            return
        end = chunk[-len(_START) :]
