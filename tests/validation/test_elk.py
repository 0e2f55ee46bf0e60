"""Consistency checks by ELK, and errors if Java or ELK is missing."""

from pathlib import Path

import pytest

from tests.conftest import shared_file
from tests.graph.records import build_graph
from tests.validation.broken import ROOM
from usd2kg.errors import GraphError
from usd2kg.graph import write_graph
from usd2kg.ontology import Closure, TBox, load_tbox, read_closure
from usd2kg.query import load_graph
from usd2kg.validation import ElkAnswer, ElkClash, ask_elk, elk_jars, validate_graph
from usd2kg.validation.elk import _read_answer

SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
BASE = "https://my.lab/k/"
ELK = Path(__file__).parents[2] / "build/elk"


def missing_elk() -> str:
    try:
        elk_jars(ELK)
    except GraphError as error:
        return str(error)
    return ""


needs_elk = [pytest.mark.slow, pytest.mark.skipif(bool(missing_elk()), reason=missing_elk())]


@pytest.fixture
def good(home_tbox: TBox, tmp_path: Path) -> Path:
    path = tmp_path / "good.ttl"
    write_graph(build_graph(home_tbox, ROOM), path)
    return path


@pytest.fixture(scope="module")
def closure() -> Closure:
    tbox = load_tbox(shared_file("ontologies/soma/SOMA-HOME.owl"))
    return read_closure(tbox, ["https://ease-crc.org/ont/USD.owl"])


def spoil(path: Path, statements: str) -> Path:
    path.write_text(path.read_text("utf-8") + f"\n@prefix k: <{BASE}> .\n{statements}", encoding="utf-8")
    return path


class TestAnswers:
    def test_parses_the_output(self):
        answer = _read_answer(
            f"axioms\t12\nbeyond\t3\nimpossible\t{SOMA}Odd\nverdict\tinconsistent\n"
            f"clash\t{BASE}Cup\ntype\t{BASE}Cup\t{SOMA}Cup\nrelation\t{BASE}Cup\t{SOMA}hasShape\t{BASE}Table-shape\n"
            f"clash\t{BASE}Bowl\ntype\t{BASE}Bowl\t{SOMA}Odd\nfollows\t{BASE}Table\n"
        )
        assert answer == ElkAnswer(
            is_consistent=False,
            axioms=12,
            beyond=3,
            impossible=(SOMA + "Odd",),
            clashes=(
                ElkClash(BASE + "Bowl", ("it is soma:Odd",), SOMA + "Odd"),
                ElkClash(BASE + "Cup", ("it is soma:Cup", "soma:hasShape Table-shape"), None),
            ),
            followers=1,
        )

    def test_contradictory_individuals_become_findings(self, good: Path):
        clashes = (
            ElkClash(BASE + "Fork", ("it is soma:Fork", "it is dul:Quality"), None),
            ElkClash(BASE + "Table", ("it is soma:Odd",), SOMA + "Odd"),
        )
        answer = ElkAnswer(False, 12, 3, (SOMA + "Odd",), clashes, 0)
        found = validate_graph(load_graph(good), answer=answer).findings
        assert [(f.rule, f.prim_path, f.found) for f in found] == [
            ("elk-clash", "/Fork", "its statements: it is soma:Fork; it is dul:Quality"),
            ("elk-impossible-class", "/Table", "it is soma:Odd, which is unsatisfiable in the ontology itself"),
        ]

    def test_reports_an_inconsistency_without_an_individual(self, good: Path):
        (found,) = validate_graph(load_graph(good), answer=ElkAnswer(False, 12, 3, (), (), 0)).findings
        assert (found.rule, found.severity) == ("elk-inconsistent", "error")


class TestMissing:
    def test_reports_missing_java(self, monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
        monkeypatch.setenv("PATH", str(tmp_path))
        with pytest.raises(GraphError, match="java or javac is not on the path; expected Java 17"):
            elk_jars(None)

    def test_reports_missing_jars(self, monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
        monkeypatch.setattr("shutil.which", lambda name: f"/usr/bin/{name}")
        monkeypatch.setenv("USD2KG_ELK_JARS", str(tmp_path))
        with pytest.raises(GraphError, match=r"contains no elk-owlapi-\*\.jar; fetch ELK with Maven") as raised:
            elk_jars(None)
        assert str(tmp_path) in str(raised.value)
        (tmp_path / "elk-owlapi-0.6.0.jar").touch()
        assert elk_jars(None) == tmp_path

    def test_reports_broken_jars_and_the_time_limit(self, good: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        (tmp_path / "elk-owlapi-0.jar").touch()
        (tmp_path / "java").write_text(
            "#!/bin/sh\necho 'error: package org.semanticweb.elk.owlapi does not exist' >&2\nexit 1\n"
        )
        (tmp_path / "javac").write_text("#!/bin/sh\n")
        for name in ("java", "javac"):
            (tmp_path / name).chmod(0o755)
        monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
        with pytest.raises(GraphError, match=r"the reasoner elk failed \(error: package .* does not exist\)"):
            ask_elk(load_graph(good), Closure((), (), ()), jars=tmp_path)
        (tmp_path / "java").write_text("#!/bin/sh\nexec sleep 20\n")
        with pytest.raises(GraphError, match=r"no result after 0\.2 s; raise --reasoner-limit"):
            ask_elk(load_graph(good), Closure((), (), ()), jars=tmp_path, limit=0.2)


class TestElk:
    pytestmark = needs_elk

    def ask(self, path: Path, closure: Closure) -> ElkAnswer:
        return ask_elk(load_graph(path), closure, jars=ELK)

    def test_accepts_a_consistent_graph(self, good: Path, closure: Closure):
        answer = self.ask(good, closure)
        assert (answer.is_consistent, answer.clashes, answer.followers) == (True, (), 0)
        # A defect of SOMA; no object of a scene has this class.
        assert answer.impossible == (SOMA + "PreferenceOrder",)
        assert 0 < answer.beyond < answer.axioms

    def test_finds_disjoint_classes(self, good: Path, closure: Closure):
        answer = self.ask(spoil(good, "k:Fork a soma:Localization ."), closure)
        assert not answer.is_consistent
        (clash,) = answer.clashes
        assert (clash.iri, clash.impossible) == (BASE + "Fork", None)
        assert set(clash.statements) == {"it is soma:Fork", "it is soma:Localization"}

    def test_finds_a_relation_that_contradicts_the_class(self, good: Path, closure: Closure):
        # The domain of hasShape is disjoint with regions.
        answer = self.ask(spoil(good, "k:Fork-box soma:hasShape k:Fork-shape ."), closure)
        assert [clash.iri for clash in answer.clashes] == [BASE + "Fork-box"]
        assert set(answer.clashes[0].statements) == {"it is soma:BoxShape", "soma:hasShape Fork-shape"}
        # The fork's shape has that box as its region, and the fork has that shape: both follow.
        assert answer.followers >= 2

    def test_finds_a_member_of_an_unsatisfiable_class(self, good: Path, closure: Closure):
        answer = self.ask(spoil(good, "k:Fork a soma:PreferenceOrder ."), closure)
        assert answer.clashes == (ElkClash(BASE + "Fork", ("it is soma:PreferenceOrder",), SOMA + "PreferenceOrder"),)
