"""The commands on a small stage: data on stdout, messages on stderr."""

import csv
import io
import json
from pathlib import Path
from typing import ClassVar

import pyoxigraph as ox
import pytest

from tests.cli.conftest import Run
from usd2kg.grounding import read_grounding
from usd2kg.query import load_graph

PATHS = ["/Room/Table_1", "/Room/coffee_mug", "/Room/FruitBowl", "/Room/Apple"]
SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
DUL = "http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#"


def rows_of(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


class TestBuild:
    def test_writes_the_graph_and_prints_a_summary_to_stderr(self, run: Run, room: Path):
        done = run("build", room)
        assert (done.code, done.out) == (0, "")
        assert [path.name for path in Path().iterdir()] == ["room.ttl"]
        assert "4 objects" in done.err
        assert "2 on, 1 inside" in done.err
        assert "written to room.ttl" in done.err
        assert load_graph(Path("room.ttl")).ask(["in", "bowl"]).rows[0][0] == "Apple"

    def test_prints_json(self, run: Run, room: Path):
        done = run("build", room, "--json")
        data = json.loads(done.out)
        assert (data["scene"], data["objects"], data["output"]) == (str(room), 4, "room.ttl")
        assert data["relations"] == {"on": 2, "inside": 1}
        assert data["triples"] == len(load_graph(Path("room.ttl")))
        assert sum(data["status"].values()) == sum(data["confidence"].values()) == 4
        assert done.err == ""

    def test_uses_ontology_base_and_profile(self, run: Run, room: Path, lab: Path):
        base = "https://my.lab/k/"
        assert run("build", room, "--ontology", lab, "--base", base, "--profile", "plain", "-o", "g.ttl").code == 0
        store = load_graph(Path("g.ttl"))
        found = store.sparql("SELECT ?o { ?o a <https://lab.example/onto#Bench> }")
        assert found.rows == ((f"{base}Room.Table_1",),)
        assert store.sparql("ASK { ?s u2k:hasObject ?o }").rows == (("true",),)
        assert not [quad for quad in ox.parse(path="g.ttl") if "ease-crc" in str(quad)]

    def test_uses_dictionary_regime_and_evidence(self, run: Run, room: Path, tmp_path: Path):
        table = tmp_path / "names.csv"
        table.write_text("name,class\ncoffee_mug,Cup\n", encoding="utf-8")
        done = run("build", room, "--grounder", "dictionary", "--dictionary", table, "--evidence", "name", "--json")
        assert json.loads(done.out)["status"] == {"refused": 3, "grounded": 1}
        done = run("build", room, "--regime", "opaque-anonymous", "--json")
        status = json.loads(done.out)["status"]
        assert sum(status.values()) == 4
        assert set(status) <= {"grounded", "superclass"}

    def test_writes_several_graphs_to_a_folder(self, run: Run, room: Path, tmp_path: Path):
        second = room.with_name("hall.usda")
        second.write_bytes(room.read_bytes())
        folder = tmp_path / "graphs"
        folder.mkdir()
        done = run("build", room, second, "-o", folder, "--json")
        assert done.code == 0
        assert [item["output"] for item in json.loads(done.out)] == [str(folder / "room.ttl"), str(folder / "hall.ttl")]
        assert sorted(path.name for path in folder.iterdir()) == ["hall.ttl", "room.ttl"]

    def test_writes_one_graph_to_a_folder(self, run: Run, room: Path, tmp_path: Path):
        folder = tmp_path / "graphs"
        folder.mkdir()
        assert run("build", room, "-o", folder).code == 0
        assert [path.name for path in folder.iterdir()] == ["room.ttl"]

    @pytest.mark.parametrize("first", [True, False])
    def test_builds_the_other_scenes_if_one_fails(self, run: Run, room: Path, first: bool):
        bad = room.with_name("bad.usda")
        bad.write_text("#usda 1.0\nthis is not a layer", encoding="utf-8")
        scenes = [bad, room] if first else [room, bad]
        done = run("build", *scenes, "--json")
        assert done.code == 2
        assert [item["scene"] for item in json.loads(done.out)] == [str(room)]
        assert [path.name for path in Path().iterdir()] == ["room.ttl"]
        assert [line for line in done.err.splitlines() if line.startswith("usd2kg: ")] == done.err.splitlines()
        assert str(bad) in done.err
        assert "Traceback" not in done.err

    def test_rejects_scenes_with_the_same_file_name(self, run: Run, room: Path):
        other = room.parent / "other" / "room.usda"
        other.parent.mkdir()
        other.write_bytes(room.read_bytes())
        done = run("build", room, other)
        assert done.code == 2
        assert "same file name" in done.err
        assert list(Path().iterdir()) == []

    def test_output_is_deterministic(self, run: Run, room: Path):
        run("build", room, "-o", "first.ttl")
        run("build", room, "-o", "second.ttl")
        assert Path("first.ttl").read_bytes() == Path("second.ttl").read_bytes()

    def test_annotates_with_triple_terms(self, run: Run, room: Path):
        assert run("build", room, "--annotations", "rdf12", "-o", "g.nt").code == 0
        lines = Path("g.nt").read_text("utf-8").splitlines()
        assert sum("#reifies> <<( " in line for line in lines) == 7, "four types and three relations"
        assert not [line for line in lines if "annotatedSource" in line]

    def test_takes_the_time_stamp_from_option_or_environment(
        self, run: Run, room: Path, monkeypatch: pytest.MonkeyPatch
    ):
        ended = "SELECT ?t { ?r prov:endedAtTime ?t }"
        assert run("build", room, "-o", "g.ttl", "--time-of-run", "2026-07-15T14:00:00+02:00").code == 0
        assert load_graph(Path("g.ttl")).sparql(ended).rows == (("2026-07-15T12:00:00Z",),)
        monkeypatch.setenv("SOURCE_DATE_EPOCH", "86400")
        assert run("build", room, "-o", "g.ttl").code == 0
        assert load_graph(Path("g.ttl")).sparql(ended).rows == (("1970-01-02T00:00:00Z",),)
        monkeypatch.setenv("SOURCE_DATE_EPOCH", "")
        assert run("build", room, "-o", "g.ttl").code == 0
        assert load_graph(Path("g.ttl")).sparql(ended).rows == ()

    def test_merges_imports(self, run: Run, room: Path, lab: Path):
        done = run("build", room, "--ontology", lab, "--merge-imports", "-o", "g.ttl")
        assert (done.code, "missing-import" in done.err) == (0, False)
        store = load_graph(Path("g.ttl"))
        assert store.sparql("ASK { ?o owl:imports ?i }").rows == (("false",),)
        bench = "ASK { <https://lab.example/onto#Bench> rdfs:comment 'To work at.'@en }"
        assert store.sparql(bench).rows == (("true",),)
        assert store.sparql("ASK { u2k:near a owl:SymmetricProperty }").rows == (("true",),)

    def test_reports_missing_imports(self, run: Run, room: Path):
        done = run("build", room, "--merge-imports")
        assert done.code == 0
        missing = [line for line in done.err.splitlines() if line.startswith("missing-import: ")]
        assert [line.split()[1] for line in missing] == [
            "<http://www.ease-crc.org/ont/SOMA-HOME.owl>",
            "<https://ease-crc.org/ont/USD.owl>",
        ]

    def test_reviewer_signs_decisions_that_state_none(self, run: Run, room: Path):
        Path("decisions.csv").write_text("path,decision,reviewer\n/Room/coffee_mug,Bowl,\n/Room/Apple,none,Bob\n")
        options = ("--decisions", "decisions.csv", "--reviewer", "https://orcid.org/0000-0002-1825-0097")
        assert run("build", room, "-o", "room.ttl", *options).code == 0
        graph = load_graph("room.ttl")
        found = graph.sparql(
            "SELECT DISTINCT ?who { { ?x sssom:reviewer_id ?who } UNION { ?x sssom:reviewer_label ?who } }"
        )
        assert {row[0] for row in found.rows} == {"https://orcid.org/0000-0002-1825-0097", "Bob"}
        done = run("build", room, "-o", "room.ttl", "--reviewer", "Ann")
        assert (done.code, done.err) == (
            2,
            "usd2kg: --reviewer Ann: there are no decisions; give them with --decisions\n",
        )

    def test_leaves_the_source_unchanged(self, run: Run, room: Path):
        before = room.read_bytes()
        run("build", room)
        assert room.read_bytes() == before
        assert [path.name for path in room.parent.iterdir() if path.is_file()] == ["room.usda"]


class TestInspect:
    def test_lists_objects_sizes_and_left_out_prims(self, run: Run, room: Path):
        done = run("inspect", room)
        assert (done.code, done.err) == (0, "")
        assert all(path in done.out for path in PATHS)
        assert "1.60 × 0.80 × 0.70" in done.out
        assert "4 objects among" in done.out
        assert "1 camera" in done.out

    def test_prints_json(self, run: Run, room: Path):
        done = run("inspect", room, "--json")
        data = json.loads(done.out)
        assert [item["path"] for item in data["objects"]] == PATHS
        assert data["objects"][0]["size"] == pytest.approx([1.6, 0.8, 0.7])
        assert data["left_out"]["camera"] == 1
        assert data["families"] == {"/Room": ["Table_1", "coffee_mug", "FruitBowl", "Apple"]}
        assert data["frame"]["up_axis"] == "Z"

    def test_replaces_control_characters(self, run: Run, write_stage):
        scene = write_stage('def Cube "cup" ( displayName = "a\\x1b[2Jb" \n doc = "\\x07" ) {}\n')
        done = run("inspect", scene)
        assert "\x1b" not in done.out
        assert "\x07" not in done.out


class TestGround:
    HEADER: ClassVar = [
        *("path", "class", "label", "confidence", "status", "grounder"),
        *("concept", "concept_label", "concept_confidence"),
    ]

    def test_prints_csv_in_scene_order(self, run: Run, room: Path):
        done = run("ground", room)
        assert (done.code, done.err) == (0, "")
        rows = rows_of(done.out)
        assert done.out.splitlines()[0] == ",".join(self.HEADER)
        assert [row["path"] for row in rows] == PATHS
        assert [row["class"] for row in rows] == [
            f"{SOMA}Table",
            f"{SOMA}Cup",
            f"{SOMA}Bowl",
            f"{DUL}DesignedArtifact",
        ]
        assert {row["grounder"] for row in rows} == {"lexical"}
        assert rows[1]["label"] == "cup"
        assert all(0 <= float(row["confidence"]) <= 1 for row in rows)

    @pytest.mark.parametrize("regime", ["semantic", "abbreviated", "opaque", "opaque-anonymous"])
    def test_prints_authored_paths_under_every_regime(self, run: Run, room: Path, regime: str):
        done = run("ground", room, "--regime", regime)
        assert [row["path"] for row in rows_of(done.out)] == PATHS
        assert all(row["class"].startswith("http") for row in rows_of(done.out))

    def test_paths_select_and_order_the_rows(self, run: Run, room: Path, tmp_path: Path):
        wanted = tmp_path / "paths.csv"
        wanted.write_text("path\n/Room/Apple\n/Room/Ghost\n/Room/Table_1\n/Room/Apple\n", encoding="utf-8")
        done = run("ground", room, "--paths", wanted)
        assert done.code == 0
        rows = rows_of(done.out)
        assert [row["path"] for row in rows] == ["/Room/Apple", "/Room/Ghost", "/Room/Table_1"]
        assert rows[1] == dict(
            zip(self.HEADER, ["/Room/Ghost", "", "", "", "missing", "lexical", "", "", ""], strict=True)
        )
        assert done.err == f"{room}: no prim /Room/Ghost; its row has the status missing\n"

    def test_grounds_listed_prims_that_the_rules_do_not_select(self, run: Run, room: Path, tmp_path: Path):
        wanted = tmp_path / "paths.csv"
        wanted.write_text("path\n/Room\n/Room/coffee_mug/geo\n", encoding="utf-8")
        rows = rows_of(run("ground", room, "--paths", wanted).out)
        assert [row["path"] for row in rows] == ["/Room", "/Room/coffee_mug/geo"]
        assert "missing" not in {row["status"] for row in rows}

    def test_selection_does_not_change_the_rows(self, run: Run, room: Path, tmp_path: Path):
        wanted = tmp_path / "paths.csv"
        wanted.write_text("path\n/Room/FruitBowl\n", encoding="utf-8")
        (row,) = rows_of(run("ground", room, "--paths", wanted).out)
        assert row in rows_of(run("ground", room).out)

    def test_json_reads_back(self, run: Run, room: Path):
        assert run("ground", room, "--format", "json", "-o", "mapping.json").out == ""
        grounding = read_grounding(Path("mapping.json"))
        assert [p.prim_path for p in grounding.predictions] == PATHS
        assert grounding.scene == str(room)
        printed = run("ground", room, "--format", "json").out
        assert printed == Path("mapping.json").read_text(encoding="utf-8")

    def test_file_has_the_content_of_stdout(self, run: Run, room: Path):
        printed = run("ground", room).out
        assert run("ground", room, "-o", "mapping.csv").out == ""
        assert Path("mapping.csv").read_bytes() == printed.encode()

    def test_uses_another_ontology(self, run: Run, room: Path, lab: Path):
        rows = rows_of(run("ground", room, "--ontology", lab).out)
        assert [row["class"].rpartition("#")[2] for row in rows[:2]] == ["Bench", "Vessel"]

    def test_uses_the_dictionary_grounder(self, run: Run, room: Path):
        rows = rows_of(run("ground", room, "--grounder", "dictionary").out)
        assert {(row["class"], row["confidence"], row["status"], row["grounder"]) for row in rows} == {
            ("", "", "refused", "dictionary")
        }


class TestQuery:
    def test_prints_a_table_and_a_count(self, run: Run, graph: Path):
        done = run("query", graph, "what", "is", "on", "the", "table?")
        assert (done.code, done.err) == (0, "")
        head, *rows, count = done.out.splitlines()
        assert head.split() == ["object", "class", "path", "anchor", "gap_m"]
        assert [row.split()[0] for row in rows] == ["FruitBowl", "coffee_mug"]
        assert count == "2 rows"

    def test_joins_the_words_of_a_question(self, run: Run, graph: Path):
        assert run("query", graph, "in bowl").out == run("query", graph, "in", "bowl").out

    def test_prints_json(self, run: Run, graph: Path):
        done = run("query", graph, "where", "is", "apple", "--json")
        (row,) = json.loads(done.out)
        assert (row["object"], row["inside"], row["on"]) == ("Apple", "FruitBowl", None)

    def test_prints_a_count_of_zero(self, run: Run, graph: Path):
        assert run("query", graph, "on", "apple").out == "0 rows\n"
        assert json.loads(run("query", graph, "on", "apple", "--json").out) == []

    def test_runs_sparql_from_argument_or_file(self, run: Run, graph: Path):
        query = "SELECT ?l { ?o a soma:Cup ; rdfs:label ?l }"
        done = run("query", graph, "--sparql", query)
        assert done.out == "l\ncoffee_mug\n1 row\n"
        Path("cups.rq").write_text(query, encoding="utf-8")
        assert run("query", graph, "--sparql", "@cups.rq") == done
        without_at = run("query", graph, "--sparql", "cups.rq")
        assert (without_at.code, without_at.out) == (2, "")
        assert "--sparql cups.rq: is a file; expected a query, or @cups.rq to read it from there" in without_at.err

    @pytest.mark.parametrize("arguments", [[], ["on", "table", "--sparql", "ASK {}"]])
    def test_rejects_no_query_and_several_queries(self, run: Run, graph: Path, arguments: list[str]):
        done = run("query", graph, *arguments)
        assert (done.code, done.out) == (2, "")
        assert done.err == (
            "usd2kg: query: expected a graph and either a question, like 'on table', --question with an ID of --list, "
            "or --sparql with a query\n"
        )


class TestOntology:
    def test_shows_a_tree(self, run: Run, lab: Path):
        done = run("ontology", "show", lab)
        assert done.code == 0
        lines = done.out.splitlines()
        assert len(lines) == 3
        assert "Equipment" in lines[0]
        assert lines[1].startswith(" ")
        assert "To work at." not in done.out
        assert "3 classes in scope, 1 root" in done.err
        assert "To work at." in run("ontology", "show", lab, "--comments").out

    def test_shows_json(self, run: Run, lab: Path):
        data = json.loads(run("ontology", "show", lab, "--json").out)
        assert [item["iri"].rpartition("#")[2] for item in data["classes"]] == ["Bench", "Equipment", "Vessel"]
        assert data["ontology"] == "https://lab.example/onto"

    def test_prints_iris_in_scope(self, run: Run, lab: Path):
        done = run("ontology", "scope", lab)
        iris = [f"https://lab.example/onto#{name}" for name in ("Bench", "Equipment", "Vessel")]
        assert done.out.splitlines() == iris
        assert json.loads(run("ontology", "scope", lab, "--json").out) == iris

    def test_root_limits_the_scope(self, run: Run, lab: Path):
        done = run("ontology", "scope", lab, "--root", "https://lab.example/onto#Bench")
        assert done.out == "https://lab.example/onto#Bench\n"

    def test_linearizes_flat_and_as_tree(self, run: Run, lab: Path):
        flat = run("ontology", "linearize", lab).out
        assert len(flat.splitlines()) == 3
        tree = run("ontology", "linearize", lab, "--tree").out
        assert len(tree.splitlines()) >= 3
        assert tree != flat

    def test_prints_the_vocabulary(self, run: Run):
        done = run("ontology", "vocabulary")
        assert (done.code, done.err) == (0, "")
        facts = {str(quad.triple) for quad in ox.parse(done.out, format=ox.RdfFormat.TURTLE)}
        assert any("<https://w3id.org/usd2kg>" in fact and "owl#Ontology" in fact for fact in facts)

    def test_defaults_to_the_built_in_ontology(self, run: Run):
        done = run("ontology", "scope")
        assert len(done.out.splitlines()) == 102
        assert f"{SOMA}Cup" in done.out.splitlines()

    def test_check_prints_counts_and_findings(self, run: Run, lab: Path):
        done = run("ontology", "check", lab)
        lines = done.out.splitlines()
        assert any(line.startswith("with a definition or comment") for line in lines)
        assert lines[-1].endswith("on 3 classes")
        data = json.loads(run("ontology", "check", lab, "--json").out)
        assert data["classes"] == 3
        is_serious = any(finding["severity"] != "note" for finding in data["findings"])
        assert done.code == int(is_serious)

    def test_check_has_no_findings_on_the_built_in_ontology(self, run: Run):
        done = run("ontology", "check")
        assert (done.code, done.out.splitlines()[-1]) == (0, "0 findings on 102 classes")

    def test_align_writes_a_file_that_ground_uses(self, run: Run, room: Path, tmp_path: Path):
        done = run("ontology", "align", "-o", tmp_path / "home.sssom.tsv")
        assert (done.code, done.out, done.err) == (0, "", "built-in home TBox: 102 classes in scope, 3 roots\n")
        built = run("ground", room).out
        assert run("ground", room, "--alignment", tmp_path / "home.sssom.tsv").out == built
        edits = tmp_path / "edits.tsv"
        edits.write_text(
            "subject_id\tsubject_label\tpredicate_id\tobject_id\tmapping_justification\n"
            "\tapple\tskos:exactMatch\tsoma:Bowl\tsemapv:ManualMappingCuration\n"
        )
        rows = {row["path"]: row["class"] for row in rows_of(run("ground", room, "--alignment", edits).out)}
        assert (
            rows["/Room/Apple"] == f"{SOMA}Bowl" != {row["path"]: row["class"] for row in rows_of(built)}["/Room/Apple"]
        )
        assert run("build", room, "--alignment", edits, "-o", tmp_path / "room.ttl").code == 0
        assert "alignment=sha256:" in (tmp_path / "room.ttl").read_text("utf-8")
        gold = tmp_path / "gold.csv"
        gold.write_text("path,class\n/Room/Apple,Bowl\n", encoding="utf-8")
        scored = json.loads(run("eval", "run", room, "--gold", gold, "--alignment", edits, "--json").out)
        assert (scored["ema"], scored["settings"]["alignment"][:7]) == (100, "sha256:")

    def test_align_writes_to_stdout(self, run: Run, tmp_path: Path):
        lab = tmp_path / "lab.ttl"
        lab.write_text(
            "@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
            "<http://x.example/lab> a owl:Ontology . <http://x.example/lab#Thing> a owl:Class .\n"
            "<http://x.example/lab#Beaker> a owl:Class ; rdfs:subClassOf <http://x.example/lab#Thing> .\n",
            encoding="utf-8",
        )
        done = run("ontology", "align", lab)
        assert (done.code, done.out.partition("\n")[0]) == (0, '#sssom_version: "1.1"')
        assert run("ontology", "align", lab, "-o", "-").out == done.out
        assert list(Path().iterdir()) == []

    def test_a_bad_row_is_named_with_its_line(self, run: Run, room: Path, tmp_path: Path):
        edits = tmp_path / "edits.tsv"
        edits.write_text(
            "subject_id\tsubject_label\tpredicate_id\tobject_id\tmapping_justification\n"
            "\tapple\tskos:exactMatch\tsoma:Nope\tsemapv:ManualMappingCuration\n"
        )
        done = run("ground", room, "--alignment", edits)
        assert (done.code, done.out) == (2, "")
        assert done.err.startswith(f"usd2kg: {edits}: line 2: built-in home TBox: ")
        assert "SOMA.owl#Nope' names no class of the 102 in scope; expected an IRI" in done.err

    def test_align_suggests_subclasses(self, run: Run, room: Path, tmp_path: Path):
        done = run("ontology", "align", "--subclasses", tmp_path / "more.ttl", "--scene", room)
        assert (done.code, done.out) == (0, "")
        assert "  1 object: apple ⊑ DesignedArtifact, like /Room/Apple" in done.err.splitlines()
        rows = {row["path"]: row for row in rows_of(run("ground", room, "--ontology", tmp_path / "more.ttl").out)}
        assert rows["/Room/Apple"]["label"] == "apple"

    @pytest.mark.parametrize(
        ("arguments", "message"),
        [
            (
                ["ontology", "align", "--subclasses", "x.ttl"],
                "--subclasses and --scene require each other; expected both",
            ),
            (
                ["ontology", "align", "--scene", "room.usda"],
                "--subclasses and --scene require each other; expected both",
            ),
            (
                ["ground", "room.usda", "--grounder", "volume", "--alignment", "x.tsv"],
                "grounder 'volume' takes no alignment; choose the grounder lexical",
            ),
            (
                ["ground", "room.usda", "--grounder", "llm-B:openai:m@http://127.0.0.1:9", "--alignment", "x.tsv"],
                "--alignment is for the lexical grounder",
            ),
            (["ground", "room.usda", "--alignment", "none.tsv"], "none.tsv: cannot be read as an alignment"),
        ],
    )
    def test_alignments_that_cannot_be_used(self, run: Run, room: Path, arguments: list[str], message: str):
        done = run(*(room if argument == "room.usda" else argument for argument in arguments))
        assert (done.code, done.out) == (2, "")
        assert message in done.err

    def test_lists_known_ontologies(self, run: Run):
        assert [line.split()[0] for line in run("ontology", "known").out.splitlines()[1:4]] == [
            "home",
            "places",
            "soma-home",
        ]
        assert json.loads(run("ontology", "known", "--json").out)[2]["documents"][0]["file"] == "SOMA-HOME.owl"

    def test_known_ontologies_have_the_number_of_classes_with_a_shipped_alignment(self, run: Run):
        entries = {entry["name"]: entry for entry in json.loads(run("ontology", "known", "--json").out)}
        assert entries["soma-home"]["aligned_classes"] == 0
        assert entries["cco-artifacts"]["aligned_classes"] > 250
        (line,) = [line for line in run("ontology", "known").out.splitlines() if line.startswith("brick ")]
        assert line.split()[1:4] == ["1.4", "–", str(entries["brick"]["aligned_classes"])]

    def test_rejects_an_unknown_ontology(self, run: Run):
        done = run("ontology", "fetch", "nope")
        assert (done.code, done.out) == (2, "")
        assert "ontology 'nope' is unknown; expected one of home, places, soma-home" in done.err


class TestDemo:
    def test_builds_and_queries_the_demo_kitchen(self, run: Run):
        done = run("demo")
        assert (done.code, done.err) == (0, "")
        assert "written to kitchen.ttl" in done.out
        assert done.out.count("$ usd2kg query kitchen.ttl ") == 3
        assert len(load_graph(Path("kitchen.ttl"))) > 1000

    def test_prints_json(self, run: Run):
        data = json.loads(run("demo", "-o", "demo.ttl", "--json").out)
        assert data["output"] == "demo.ttl"
        assert len(data["answers"]) == 3
        assert all(data["answers"].values())
