"""usd2kg validate: text, JSON and exit codes."""

import json
from pathlib import Path

import pytest

from tests.cli.conftest import Run
from tests.graph.records import build_graph, thing
from tests.grounding.records import make_object
from tests.validation.broken import ROOM
from tests.validation.test_elk import ELK, missing_elk
from usd2kg.graph import write_graph
from usd2kg.ontology import TBox

LARGE_FORK = thing("/Fork\u202e", (-2, -2, 0), (3.0, 0.3, 0.1), display_name="Fork\x1b[31m\n  error [x]")


@pytest.fixture
def good(home_tbox: TBox, tmp_path: Path) -> Path:
    path = tmp_path / "good.ttl"
    write_graph(build_graph(home_tbox, ROOM), path)
    return path


@pytest.fixture
def odd(home_tbox: TBox, tmp_path: Path) -> Path:
    path = tmp_path / "odd.ttl"
    write_graph(build_graph(home_tbox, [*ROOM, (LARGE_FORK, "Fork")]), path)
    return path


def test_valid_graph_has_no_findings(run: Run, good: Path):
    done = run("validate", good)
    assert (done.code, done.out) == (0, "0 findings on 7 objects\n")


def test_says_what_the_built_in_ontology_lacks(run: Run, good: Path):
    message = (
        "ontology: the built-in ontology stands in for <http://www.ease-crc.org/ont/SOMA-HOME.owl>: classes and "
        "hierarchy are checked, disjointness, domains and ranges are not; name its file with --ontology to check them"
    )
    lines = run("validate", good).err.splitlines()
    assert [line for line in lines if "SOMA-HOME" in line] == [message]


def test_prints_findings_as_text(run: Run, odd: Path):
    done = run("validate", odd)
    assert done.code == 1
    # Escape sequences, newlines and bidirectional controls in names are replaced.
    assert done.out.splitlines() == [
        "warning [unusual-size] Fork\ufffd[31m error [x] /Fork\ufffd",
        "  found:    its longest extent is 3 m (3 × 0.3 × 0.1 m), and it is a fork",
        "  expected: about 0.195 m, 0.039 to 0.98 m",
        "  do:       Check metersPerUnit of the stage and the scale of the prim; "
        "if the size is right, correct the class.",
        "",
        "1 finding (1 warning) on 8 objects",
    ]


def test_prints_findings_as_json(run: Run, odd: Path):
    done = run("validate", odd, "--json")
    assert done.code == 1
    assert "\x1b" not in done.out
    report = json.loads(done.out)
    assert (report["profile"], report["objects"]) == ("soma", 8)
    assert report["counts"] == {"error": 0, "warning": 1, "note": 0}
    assert report["findings"][0]["rule"] == "unusual-size"


def test_rules_file_overrides_thresholds(run: Run, odd: Path, tmp_path: Path):
    rules = tmp_path / "rules.toml"
    rules.write_text("[unusual-size]\nfactor = 40.0\n")
    assert run("validate", odd, "--rules", rules).code == 0
    rules.write_text("[unusual-size]\nfaktor = 40.0\n")
    done = run("validate", odd, "--rules", rules)
    assert done.code == 2
    assert "has no key 'faktor'; expected enabled, severity, factor" in done.err


def test_limits_findings_of_a_rule_without_all(run: Run, home_tbox: TBox, tmp_path: Path):
    path = tmp_path / "many.ttl"
    # 1 g in a box of 0.19 · 0.03 · 0.02 m³ is 8.77 kg/m³, below the least density of the rules file.
    forks = [(thing(f"/Fork{i:02}", (i, 2, 0), (0.19, 0.03, 0.02), mass_kg=0.001), "Fork") for i in range(25)]
    write_graph(build_graph(home_tbox, forks), path)
    rules = tmp_path / "rules.toml"
    rules.write_text("[density]\nlowest = 9.0\n")
    cut = run("validate", path, "--rules", rules).out.splitlines()
    assert sum(line.startswith("warning [density]") for line in cut) == 20
    assert "… 5 more of density (--all shows them)" in cut
    assert cut[-1] == "25 findings (25 warnings) on 25 objects"
    assert run("validate", path, "--rules", rules, "--all").out.count("[density]") == 25


def test_says_which_rules_the_graph_lacks_the_facts_for(run: Run, home_tbox: TBox, tmp_path: Path):
    path = tmp_path / "bare.ttl"
    things = [(make_object(f"/Cup{i}"), "Cup") for i in range(3)]
    write_graph(build_graph(home_tbox, things), path)
    done = run("validate", path)
    assert "not checked: scene-scale, room-size, unusual-size, in-the-air, " in done.err
    assert ": no object has a box; check usd2kg inspect for missing geometry" in done.err
    assert (
        "not checked: support-circle: no object is on or inside another; if the graph was built without relations"
        in done.err
    )
    assert "not checked: low-confidence: the confidences of this grounder are not calibrated" in done.err
    report = json.loads(run("validate", path, "--json").out)
    assert {"rules": ["orientation-not-unit"], "reason": "no object has an orientation"} in report["skipped"]


def test_a_complete_graph_skips_nothing_of_boxes_and_relations(run: Run, good: Path):
    skipped = json.loads(run("validate", good, "--json").out)["skipped"]
    assert [entry["rules"] for entry in skipped] == [["concept-classes"], ["low-confidence"]]


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("none.ttl", None, "no such file"),
        ("empty.ttl", "", "contains no usd:Prim"),
        ("broken.ttl", "<a", "does not parse"),
    ],
)
def test_rejects_invalid_graphs(run: Run, tmp_path: Path, name: str, text: str | None, message: str):
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    done = run("validate", path)
    assert (done.code, done.out) == (2, "")
    assert message in done.err


def test_reports_another_ontology(run: Run, good: Path, tmp_path: Path):
    lab = tmp_path / "lab.ttl"
    lab.write_text(
        "@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        "<https://lab.example/onto> a owl:Ontology . <https://lab.example/onto#A> a owl:Class .\n"
        "<https://lab.example/onto#B> a owl:Class ; rdfs:subClassOf <https://lab.example/onto#A> .\n"
    )
    done = run("validate", good, "--ontology", lab)
    assert "SOMA-HOME.owl>, and" in done.err
    other = tmp_path / "other.ttl"
    other.write_text(good.read_text().replace("http://www.ease-crc.org/ont/SOMA-HOME.owl", "https://lab.example/onto"))
    done = run("validate", other)
    assert (done.code, done.out) == (0, "0 findings on 7 objects\n")
    assert "name its file with --ontology" in done.err


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_prints_the_shapes(run: Run, profile: str):
    done = run("ontology", "shapes", "--profile", profile)
    assert done.code == 0
    assert "rule:object-label a sh:PropertyShape" in done.out
    assert run("ontology", "shapes", "--profile", "rdf").code == 2


def test_rejects_an_unknown_or_missing_reasoner(run: Run, good: Path, tmp_path: Path):
    done = run("validate", good, "--reasoner", "pellet")
    assert (done.code, done.err) == (2, "usd2kg: reasoner 'pellet' is unknown; expected elk\n")
    done = run("validate", good, "--reasoner", "elk", "--elk-jars", tmp_path)
    assert (done.code, done.out) == (2, "")
    assert done.err.startswith("usd2kg: reasoner elk: ")


@pytest.mark.slow
@pytest.mark.skipif(bool(missing_elk()), reason=missing_elk())
def test_reports_an_inconsistency_found_by_elk(run: Run, good: Path):
    done = run("validate", good, "--reasoner", "elk", "--elk-jars", ELK)
    assert done.code == 0
    assert "\nelk: consistent; " in done.err
    clash = "\nsoma:Fork owl:disjointWith soma:Bread . <https://my.lab/k/Fork> a soma:Bread .\n"
    good.write_text(good.read_text("utf-8") + clash, encoding="utf-8")
    done = run("validate", good, "--reasoner", "elk", "--elk-jars", ELK, "--json")
    assert done.code == 1
    report = json.loads(done.out)
    assert (report["reasoner"]["name"], report["reasoner"]["is_consistent"]) == ("elk", False)
    assert [f["prim_path"] for f in report["findings"] if f["rule"] == "elk-clash"] == ["/Fork"]
