"""Protection against deeply nested documents.

The parsers of OWL, JSON-LD and triple terms recurse without a limit: a document of a few kilobytes overflows the stack,
which ends the process. The parser of RDF/XML takes time quadratic in the depth.
"""

import re
from collections.abc import Callable, Iterable
from typing import BinaryIO, Literal
from xml.parsers import expat

from usd2kg.ontology.limits import NESTING

__all__ = ["refuse_deep_nesting", "refuse_deep_nesting_in_file"]

_CHUNK = 1 << 20
_OWL_TOKEN = re.compile(
    r'"(?:[^"\\]|\\.)*+"?|<[^<>\s]*+>|#[^\n]*|[(){},]|(?<![\w:-])(?:some|only|not|min|max|exactly|and|or)(?![\w:-])',
    flags=re.DOTALL,
)
"""Text, IRIs and comments are tokens, so that brackets in them do not count."""
_JSON_TOKEN = re.compile(rb'\\.|["{}\[\]]', flags=re.DOTALL)
_TERM_START, _TERM_END = b"<<(", b")>>"


def refuse_deep_nesting(text: str, syntax: str) -> None:
    """Raise SyntaxError if a document is nested deeper than its parser can follow; `NestingLimits` has the limits.

    Args:
        text: the document.
        syntax: `ofn`, `omn`, `owx`, `rdf`, `ttl` or `jsonld`.
    """
    if syntax in {"ofn", "omn"}:
        _check_owl(text)
    elif syntax in {"owx", "rdf"}:
        _check_xml(text, NESTING.owl_levels if syntax == "owx" else NESTING.rdf_xml_levels)
    elif syntax == "jsonld":
        _check_json([text.encode(errors="replace")])
    elif syntax == "ttl":
        _check_terms([text.encode(errors="replace")])


def refuse_deep_nesting_in_file(file: BinaryIO, syntax: Literal["ttl", "jsonld"]) -> None:
    """Apply `refuse_deep_nesting` to an open file of JSON-LD or of the Turtle family, from its current position.

    Raises:
        SyntaxError: as `refuse_deep_nesting`.
        OSError, EOFError, zlib.error: it cannot be read.
    """
    check: Callable[[Iterable[bytes]], None] = _check_json if syntax == "jsonld" else _check_terms
    check(iter(lambda: file.read(_CHUNK), b""))


def _check_owl(text: str) -> None:
    """Count brackets, and the class expressions of Manchester syntax that nest without them: `p some q some …`."""
    level = 0
    outer: list[int] = []
    for token in _OWL_TOKEN.finditer(text):
        word = token[0]
        if word in {"(", "{"}:
            outer.append(level)
            level += 1
        elif word in {")", "}"}:
            level = outer.pop() if outer else 0
        elif word in {",", "and", "or"}:
            level = outer[-1] + 1 if outer else 0
        elif word[0] not in '"<#':
            level += 1
        if level > NESTING.owl_levels:
            raise _too_deep("class expressions", NESTING.owl_levels, text.count("\n", 0, token.start()) + 1)


def _check_xml(text: str, limit: int) -> None:
    parser = expat.ParserCreate()
    level = 0

    def start(_name: str, _attributes: object) -> None:
        nonlocal level
        level += 1
        if level > limit:
            raise _too_deep("elements", limit, parser.CurrentLineNumber)

    def end(_name: str) -> None:
        nonlocal level
        level -= 1

    parser.StartElementHandler, parser.EndElementHandler = start, end
    try:
        parser.Parse(text, True)
    except expat.ExpatError:
        # The actual parser of the document reports syntax errors.
        return


def _check_json(chunks: Iterable[bytes]) -> None:
    level, line, is_text, rest = 0, 1, False, b""
    for chunk in chunks:
        data = rest + chunk
        # An escape may continue in the next chunk.
        rest = data[len(data) - (len(data) - len(data.rstrip(b"\\"))) % 2 :]
        for token in _JSON_TOKEN.finditer(data):
            mark = token[0]
            if mark == b'"':
                is_text = not is_text
            elif not is_text and mark in b"{[":
                level += 1
                if level > NESTING.json_levels:
                    raise _too_deep("objects", NESTING.json_levels, line + data.count(b"\n", 0, token.start()))
            elif not is_text and mark in b"}]":
                level -= 1
        line += data.count(b"\n")


def _check_terms(chunks: Iterable[bytes]) -> None:
    """Count the triple terms that start before one ends; only the object of a triple term may be a triple term."""
    level, rest = 0, b""
    for chunk in chunks:
        data = rest + chunk
        # A mark of three bytes may continue in the next chunk.
        rest = data[-2:]
        for number, part in enumerate(data.split(_TERM_END)):
            level = part.count(_TERM_START) + (0 if number else level)
            if level > NESTING.term_levels:
                raise _too_deep("triple terms", NESTING.term_levels, None)


def _too_deep(what: str, limit: int, line: int | None) -> SyntaxError:
    where = "" if line is None else f"line {line}: "
    return SyntaxError(f"{where}{what} are nested more than {limit:,} deep, expected at most {limit:,}")
