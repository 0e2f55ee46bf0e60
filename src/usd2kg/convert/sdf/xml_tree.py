"""Elements of an untrusted XML file with their line numbers, by expat."""

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

__all__ = ["XmlElement", "XmlError", "parse_safely", "read_xml"]

_MAX_DEPTH = 100
"""Nesting of elements; those of published worlds and meshes are nested less than 20 deep."""

_BEFORE_DECLARATION = re.compile(rb"(?:\s|<!--(?:(?!-->).)*-->)+(?=<\?xml)", re.DOTALL)


class XmlError(ValueError):
    """A file is no XML, or XML that no honest file has; the message starts with the line."""


@dataclass(eq=False)
class XmlElement:
    """An element of an XML file; comments and the text after child elements are left out."""

    tag: str
    attributes: Mapping[str, str] = field(default_factory=dict)
    text: str = ""
    """Without white space around it."""
    children: list["XmlElement"] = field(default_factory=list)
    line: int = 0

    def find(self, tag: str) -> "XmlElement | None":
        """Return the first child with a tag."""
        return next(self.find_all(tag), None)

    def find_all(self, tag: str) -> Iterator["XmlElement"]:
        """Yield the children with a tag."""
        return (child for child in self.children if child.tag == tag)

    def text_of(self, tag: str) -> str:
        """Return the text of the first child with a tag, in one line; empty without one."""
        child = self.find(tag)
        return " ".join(child.text.split()) if child is not None else ""

    def name(self, attribute: str = "name") -> str:
        """Return an attribute without white space around it; empty without one."""
        return self.attributes.get(attribute, "").strip()


def read_xml(path: Path) -> XmlElement:
    """Return the root element of a file.

    Raises:
        XmlError: it is no XML, declares entities, or is nested more than 100 deep.
        OSError: it cannot be read.
    """
    above: list[XmlElement] = [XmlElement("")]
    texts: list[list[str]] = [[]]

    def start(tag: str, attributes: Mapping[str, str], line: int) -> None:
        element = XmlElement(tag, attributes, line=line)
        above[-1].children.append(element)
        above.append(element)
        texts.append([])

    def end(_: str) -> None:
        above.pop().text = "".join(texts.pop()).strip()

    def characters(text: str) -> None:
        texts[-1].append(text)

    parse_safely(path, start, end, characters)
    return above[0].children[0]


def parse_safely(
    path: Path,
    start: Callable[[str, Mapping[str, str], int], None],
    end: Callable[[str], None] | None = None,
    characters: Callable[[str], None] | None = None,
) -> None:
    """Call `start(tag, attributes, line)`, `end(tag)` and `characters(text)` for what is in a file.

    Raises:
        XmlError: as `read_xml`.
        OSError: the file cannot be read.
    """
    data = path.read_bytes()
    # Gazebo reads files with a comment or an empty line before the XML declaration, such as its own cafe.world.
    found = _BEFORE_DECLARATION.match(data)
    skipped = data[: found.end()].count(b"\n") if found else 0
    parser = expat.ParserCreate()
    depth = 0

    def line() -> int:
        return skipped + parser.CurrentLineNumber

    def open_element(tag: str, attributes: Mapping[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > _MAX_DEPTH:
            raise XmlError(f"line {line()}: its elements are nested more than {_MAX_DEPTH} deep")
        start(tag, attributes, line())

    def close_element(tag: str) -> None:
        nonlocal depth
        depth -= 1
        if end is not None:
            end(tag)

    def refuse_entity(name: str, *_: object) -> None:
        # Entities of SDFormat and COLLADA have no use but to blow up, or to read other files.
        raise XmlError(f"line {line()}: it declares the XML entity {name!r}")

    parser.buffer_text = True
    parser.StartElementHandler = open_element
    parser.EndElementHandler = close_element
    parser.CharacterDataHandler = characters
    parser.EntityDeclHandler = refuse_entity
    try:
        parser.Parse(data[found.end() :] if found else data, True)
    except expat.ExpatError as error:
        raise XmlError(f"line {skipped + error.lineno}: {expat.ErrorString(error.code)}") from error
    except XmlError:
        raise
    except (LookupError, ValueError) as error:
        # expat knows no encodings of several bytes but those of Unicode.
        raise XmlError(f"line {line()}: {error}") from error
