"""Results are well-formed in each media type, whatever characters the graph contains."""

import xml.etree.ElementTree as ET

import pyoxigraph as ox
import pytest

from usd2kg.endpoint import EndpointLimits
from usd2kg.endpoint.result_formats import render

_VALUE = "a\x00\x01b\ufffe\r\n<c>\U0001f600"
_KEPT = "a\ufffd\ufffdb\ufffd\r\n<c>\U0001f600"


@pytest.fixture
def store() -> ox.Store:
    made = ox.Store()
    made.add(ox.Quad(ox.NamedNode("urn:s"), ox.NamedNode("urn:p#x"), ox.Literal(_VALUE)))
    return made


def test_results_with_control_characters_are_well_formed_xml(store: ox.Store):
    body = render(store.query("SELECT ?o { ?s ?p ?o }"), "application/sparql-results+xml", EndpointLimits()).body
    literal = ET.fromstring(body).find(".//{http://www.w3.org/2005/sparql-results#}literal")
    assert literal is not None
    assert literal.text == _KEPT


def test_graphs_with_control_characters_are_well_formed_xml(store: ox.Store):
    body = render(store.query("CONSTRUCT WHERE { ?s ?p ?o }"), "application/rdf+xml", EndpointLimits()).body
    value = ET.fromstring(body).find(".//{urn:p#}x")
    assert value is not None
    assert value.text is not None
    assert value.text.startswith("a\ufffd\ufffdb\ufffd")


def test_json_keeps_every_character(store: ox.Store):
    body = render(store.query("SELECT ?o { ?s ?p ?o }"), "application/sparql-results+json", EndpointLimits()).body
    assert b"a\\u0000\\u0001b\\ufffe" in body
