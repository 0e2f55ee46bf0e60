"""Graph files with blank nodes, triple terms and long chains where texts and IRIs are expected: no command crashes."""

from pathlib import Path

import pytest

from tests.cli.conftest import Run

TERM = "<<( <urn:a> <urn:b> <urn:c> )>>"
JUNK = f"{TERM}, _:q, <urn:odd>, 'text', 5"
LABEL = "<http://www.w3.org/2000/01/rdf-schema#label>"
BELOW = "<http://www.w3.org/2000/01/rdf-schema#subClassOf>"
PATH = "<https://w3id.org/usd2kg#primPath>"
ODD = {
    "blank object": f"_:b a <urn:c> ; {LABEL} 'mug' ; {PATH} '/World/b' .",
    "labels": f"<urn:x> a <urn:c> ; {LABEL} _:l, <urn:lab>, {TERM} ; {PATH} '/World/x' .",
    "paths": f"<urn:x> a <urn:c>, _:k, {TERM}, 'text' ; {LABEL} 'x' ; {PATH} _:p, {TERM} .",
    "confidence": "[] <http://www.w3.org/2002/07/owl#annotatedSource> <urn:x> ; "
    "<http://www.w3.org/2002/07/owl#annotatedProperty> <http://www.w3.org/1999/02/22-rdf-syntax-ns#type> ; "
    f"<https://w3id.org/sssom/confidence> 'high', {TERM} . <urn:x> {PATH} '/World/mug' .",
    "chain of classes": f"<urn:x> a <urn:c0> ; {LABEL} 'x' ; {PATH} '/World/x' .\n"
    + "".join(f"<urn:c{i}> {BELOW} <urn:c{i + 1}> .\n" for i in range(3_000)),
    "circle of classes": f"<urn:x> a <urn:c0> ; {LABEL} 'x' ; {PATH} '/World/x' .\n"
    + "".join(f"<urn:c{i}> {BELOW} <urn:c{(i + 1) % 3_000}> .\n" for i in range(3_000)),
}


@pytest.mark.parametrize("case", ODD)
def test_odd_statements_are_left_out(run: Run, graph: Path, case: str):
    odd = graph.with_name("odd.ttl")
    odd.write_text(graph.read_text(encoding="utf-8") + ODD[case], encoding="utf-8")
    for command in (
        ["validate", odd],
        ["query", odd, "on table"],
        ["query", odd, "all of mug"],
        ["ask", odd, "where is the mug?"],
        ["graph", "export", odd],
        ["diff", odd, graph],
    ):
        done = run(*command)
        assert done.code in {0, 1}, done.err
        assert "Traceback" not in done.err


DEEP = {
    "deep.ttl": "<urn:s> <urn:p> " + "<<( <urn:a> <urn:b> " * 20_000 + "<urn:c>" + " )>>" * 20_000 + " .",
    "deep.jsonld": '{"@id":"http://x","http://x/p":' * 20_000 + "1" + "}" * 20_000,
}


@pytest.mark.parametrize("name", DEEP)
def test_a_deep_graph_is_one_error(run: Run, tmp_path: Path, name: str):
    path = tmp_path / name
    path.write_text(DEEP[name], encoding="utf-8")
    for command in (["validate", path], ["query", path, "on table"], ["diff", path, path]):
        done = run(*command)
        assert done.code == 2
        assert len(done.err.splitlines()) == 1
        assert "are nested more than 1,000 deep, expected at most 1,000" in done.err
