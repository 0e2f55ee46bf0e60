"""sniff_syntax: the syntax of an ontology document, detected by its content."""

import json
import re

__all__ = ["sniff_syntax"]

_LINE_COMMENTS = re.compile(r"(?:\s*#[^\n]*\n)*\s*")
_ELEMENT = re.compile(r"<(?:[A-Za-z_][\w.-]*:)?([A-Za-z_][\w.-]*)")
_DOCTYPE = re.compile(r"<!DOCTYPE[^\[>]*")
_IN_SUBSET = re.compile(r"<!--|\]\s*>")


def sniff_syntax(text: str) -> str | None:
    """Return the syntax of a document, `ofn`, `omn`, `owx`, `rdf`, `ttl` or `jsonld`; None if it is unknown.

    File extensions are ignored: `.owl` is used for at least three syntaxes.

    >>> sniff_syntax("# a comment\\nPrefix(:=<http://x#>)")
    'ofn'
    """
    start = text.lstrip("\ufeff \t\r\n")
    if start.startswith("<") and not re.match(r"<[a-zA-Z][a-zA-Z0-9+.-]*:[^\s<>]*>", start):
        return {"RDF": "rdf", "Ontology": "owx"}.get(_root_name(start))
    comments = _LINE_COMMENTS.match(start)
    body = start[comments.end() :] if comments else start
    if re.match(r"(Prefix|Ontology)\s*\(", body):
        return "ofn"
    if re.match(r"(Prefix|Ontology)\s*:", body):
        return "omn"
    if re.match(r"@prefix|@base|prefix\s|base\s|<|_:|\[|[\w.-]*:[\w.-]*\s", body, flags=re.IGNORECASE):
        return "jsonld" if _is_json(body) else "ttl"
    return "jsonld" if _is_json(body) else None


def _root_name(text: str) -> str:
    """Return the local name of the root element of an XML document; empty if there is none."""
    at = text.find("<")
    while at >= 0:
        if text.startswith("<!--", at):
            at = _after(text, "-->", at + 4)
        elif text.startswith("<?", at):
            at = _after(text, "?>", at + 2)
        elif doctype := _DOCTYPE.match(text, at):
            at = _after_subset(text, doctype.end())
        elif element := _ELEMENT.match(text, at):
            return element[1]
        else:
            at += 1
        at = text.find("<", at)
    return ""


def _after(text: str, end: str, start: int) -> int:
    found = text.find(end, start)
    return len(text) if found < 0 else found + len(end)


def _after_subset(text: str, start: int) -> int:
    """Return the index after a DOCTYPE; its internal subset may contain text that looks like elements."""
    if not text.startswith("[", start):
        return start
    at = start
    while found := _IN_SUBSET.search(text, at):
        if found[0] != "<!--":
            return found.end()
        at = _after(text, "-->", found.end())
    return len(text)


def _is_json(text: str) -> bool:
    if text[:1] not in {"{", "["}:
        return False
    try:
        json.loads(text)
    except ValueError:
        return False
    except RecursionError:
        # The JSON-LD parser reports the nesting limit.
        return True
    return True
