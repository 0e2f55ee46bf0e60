"""SERVICE and LOAD clauses are found in every spelling that the engine accepts."""

import socket
import threading

import pyoxigraph as ox
import pytest

from usd2kg.query.remote_clauses import has_remote_clause

CALLS = [
    "SELECT * { SERVICE <URL> { ?s ?p ?o } }",
    "SELECT * { service silent <URL>{?s ?p ?o} }",
    "SELECT * { FILTER(1<2)SERVICE#>\n <URL> { ?s ?p ?o } FILTER(2>1) }",
    "SELECT * { FILTER(1<2)SERVICE#}\n <URL> #{\n { ?s ?p ?o } }",
    "SELECT * { ?s ?p 'it' . FILTER(1<2)SERVICE<URL>{ ?s ?p ?o } }",
    "PREFIX e: <URL> SELECT * { SERVICEe:#x\n{ ?s ?p ?o } }",
    "SELECT * { VALUES ?u { <URL> } SERVICE ?u { ?s ?p ?o } }",
    "SELECT * { { SELECT * { SERVICE\n#c\nSILENT <URL> { ?s ?p ?o } } } }",
]
HARMLESS = [
    "SELECT * { ?s rdfs:label 'Service Trolley' . OPTIONAL { ?s ?p ?o } }",
    "SELECT * { ?s a <https://my.lab/Service> . { ?s ?p ?o } }",
    "# a service: none\nSELECT * { ?service ?p ?load }",
]


@pytest.mark.parametrize("query", CALLS)
def test_finds_service_clauses(query: str):
    assert has_remote_clause(query.replace("URL", "http://127.0.0.1:9/"))


@pytest.mark.parametrize("query", HARMLESS)
def test_ignores_keywords_in_names_and_labels(query: str):
    assert not has_remote_clause(query)


@pytest.mark.parametrize(
    "update", ["LOAD <http://x/>", "load silent <http://x/> into graph <urn:g>", "LOAD#\n<http://x>"]
)
def test_finds_load_clauses(update: str):
    assert has_remote_clause(update)


def test_the_engine_connects_without_the_check():
    with socket.socket() as listening:
        listening.bind(("127.0.0.1", 0))
        listening.listen()
        connected = threading.Event()

        def accept() -> None:
            connection, _ = listening.accept()
            with connection:
                connected.set()

        thread = threading.Thread(target=accept)
        thread.start()
        with pytest.raises(OSError, match=r"."):
            list(ox.Store().query(CALLS[0].replace("URL", f"http://127.0.0.1:{listening.getsockname()[1]}/")))  # type: ignore[arg-type]
        thread.join(10)
        assert connected.is_set()
