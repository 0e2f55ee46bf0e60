"""Fixtures of the ontology tests."""

from collections.abc import Callable
from pathlib import Path

import pytest

from usd2kg.ontology import TBox, load_tbox

PREFIXES = """\
@prefix : <http://example.com/home#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
@prefix dul: <http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#> .
@prefix soma: <http://www.ease-crc.org/ont/SOMA.owl#> .
"""


@pytest.fixture
def write_turtle(tmp_path) -> Callable[..., Path]:
    """Return a function that writes statements as Turtle with the usual prefixes and returns the path."""

    def write(text: str, name: str = "home.ttl") -> Path:
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(PREFIXES + text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def load(write_turtle) -> Callable[..., TBox]:
    """Return a function that writes statements as Turtle and loads them as a TBox."""

    def run(text: str, **options) -> TBox:
        return load_tbox(write_turtle(text), **options)

    return run
