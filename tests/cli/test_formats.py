"""Formats of mappings and graphs, and the export to property graphs."""

from pathlib import Path

import networkx as nx
import pytest
import rdflib

from tests.cli.conftest import Run
from usd2kg.grounding import read_grounding
from usd2kg.query import load_graph


class TestGround:
    def test_sssom_reads_back_as_decisions(self, run: Run, room: Path):
        first = run("ground", room, "--format", "sssom", "--base", "https://my.lab/k/", "-o", "m.sssom.tsv")
        assert (first.code, first.out) == (0, "")
        path = Path("m.sssom.tsv")
        lines = path.read_text("utf-8").splitlines()
        start = next(number for number, line in enumerate(lines) if line.startswith("subject_id"))
        columns = lines[start].split("\t")
        rows = [dict(zip(columns, line.split("\t"), strict=True)) for line in lines[start + 1 :]]
        mug = next(row for row in rows if row["prim_path"] == "/Room/coffee_mug")
        assert (mug["subject_id"], mug["object_id"]) == ("scene:Room.coffee_mug", "soma:Cup")
        mug.update(object_id="soma:Bowl", reviewer_label="Ann")
        path.write_text(
            "\n".join([*lines[: start + 1], *("\t".join(row.values()) for row in rows)]) + "\n", encoding="utf-8"
        )
        second = run("ground", room, "--decisions", path)
        assert "/Room/coffee_mug,http://www.ease-crc.org/ont/SOMA.owl#Bowl,bowl,1.0000,reviewed,lexical" in second.out
        assert second.out.count(",reviewed,") == 1

    def test_file_ending_selects_the_format(self, run: Run, room: Path):
        for name in ("m.json", "m.TSV", "m.csv", "m.txt"):
            assert run("ground", room, "-o", name).code == 0
        assert read_grounding(Path("m.json")).by_path["/Room/coffee_mug"].explanation
        assert Path("m.TSV").read_text("utf-8").startswith("#sssom_version")
        for name in ("m.csv", "m.txt"):
            assert Path(name).read_text("utf-8").startswith("path,class,label,")

    def test_format_option_overrides_the_ending(self, run: Run, room: Path):
        assert run("ground", room, "--format", "csv", "-o", "m.json").code == 0
        assert Path("m.json").read_text("utf-8").startswith("path,class,label,")

    def test_rejects_sssom_options_with_other_formats(self, run: Run, room: Path):
        done = run("ground", room, "--license", "https://x.org/l")
        assert done.code == 2
        assert "need --format sssom" in done.err

    def test_rejects_an_unknown_format(self, run: Run, room: Path):
        done = run("ground", room, "--format", "xml")
        assert done.code == 2
        assert "expected one of csv, json, or sssom with usd2kg ground" in done.err


class TestBuild:
    @pytest.mark.parametrize("name", ["g.trig", "g.nq", "g.rdf", "g.jsonld", "g.ttl.gz"])
    def test_every_rdf_format_can_be_queried(self, run: Run, room: Path, name: str):
        assert run("build", room, "-o", name).code == 0
        assert load_graph(Path(name)).ask(["in", "bowl"]).rows[0][0] == "Apple"


class TestConvert:
    def test_round_trip_gives_the_same_bytes(self, run: Run, graph: Path):
        for source, target in (("g.ttl", "g.nq"), ("g.nq", "g.rdf"), ("g.rdf", "again.ttl")):
            done = run("graph", "convert", graph if source == "g.ttl" else source, "-o", target)
            assert (done.code, done.out) == (0, "")
            assert f"triples written to {target}" in done.err
        assert Path("again.ttl").read_bytes() == graph.read_bytes()

    @pytest.mark.filterwarnings("ignore:ConjunctiveGraph is deprecated:DeprecationWarning")
    def test_json_ld_has_every_triple(self, run: Run, graph: Path):
        assert run("graph", "convert", graph, "-o", "g.jsonld").code == 0
        triples = len(rdflib.Graph().parse(graph, format="turtle"))
        assert len(rdflib.Graph().parse("g.jsonld", format="json-ld")) == triples

    @pytest.mark.parametrize(
        ("source", "target", "message"),
        [
            ("none.ttl", "g.nt", "none.ttl: no such file"),
            ("none.docx", "g.nt", "'.docx' names no RDF format"),
            (None, "g.docx", "'.docx' names no graph format"),
            (None, "none/g.nt", "the folder none does not exist"),
        ],
    )
    def test_rejects_invalid_files(self, run: Run, graph: Path, source: str | None, target: str, message: str):
        done = run("graph", "convert", source or graph, "-o", target)
        assert done.code == 2
        assert message in done.err
        assert done.err.count("\n") == 1


class TestExport:
    def test_writes_three_files_for_neo4j(self, run: Run, graph: Path):
        done = run("graph", "export", graph, "--to", "neo4j", "-o", "out")
        assert done.code == 0
        assert "4 nodes and" in done.err
        assert sorted(path.name for path in Path("out").iterdir()) == ["load.cypher", "nodes.csv", "relationships.csv"]
        assert ",Thing;Object;" in Path("out/nodes.csv").read_text("utf-8")

    def test_rejects_another_database(self, run: Run, graph: Path):
        done = run("graph", "export", graph, "--to", "oracle")
        assert done.code == 2
        assert "expected one of neo4j, tf, ros2" in done.err

    @pytest.mark.parametrize(
        ("target", "files", "printed"),
        [
            ("tf", ["frames.json", "tf_static.json", "tf_static.yaml"], "transforms written to g-"),
            ("ros2", ["detections.json", "relations.json"], "detections and"),
        ],
    )
    def test_writes_messages_of_ros(self, run: Run, graph: Path, target: str, files: list[str], printed: str):
        done = run("graph", "export", graph, "--to", target, "--frame", "site", "-o", f"g-{target}")
        assert (done.code, printed in done.err) == (0, True)
        assert sorted(path.name for path in Path(f"g-{target}").iterdir()) == files
        assert '"frame_id": "site"' in Path(f"g-{target}", files[0]).read_text("utf-8")

    def test_the_frame_is_for_messages_only(self, run: Run, graph: Path):
        done = run("graph", "export", graph, "--frame", "site")
        assert done.code == 2
        assert "--frame is for --to tf and --to ros2" in done.err

    def test_rejects_a_file_as_output_folder(self, run: Run, graph: Path):
        done = run("graph", "export", graph, "-o", graph)
        assert done.code == 2
        assert "is not a folder" in done.err

    def test_graphml_opens_in_networkx(self, run: Run, graph: Path):
        assert run("graph", "convert", graph, "-o", "g.graphml").code == 0
        found = nx.read_graphml("g.graphml")
        assert {data["label"] for _, data in found.nodes(data=True)} >= {"Table_1", "coffee_mug", "FruitBowl", "Apple"}


@pytest.mark.parametrize(
    ("ending", "reason"),
    [
        (
            ".ofn",
            "OWL functional syntax is read only as an ontology (--ontology, usd2kg ontology show), not as a graph",
        ),
        (".graphml", "graphs are not read from GraphML, an export format"),
    ],
)
def test_rejects_export_formats_as_input(run: Run, graph: Path, ending: str, reason: str):
    other = graph.with_suffix(ending)
    assert run("graph", "convert", graph, "-o", other).code == 0
    convert = ["graph", "convert", other, "-o", "x.ttl"]
    endings = ".ttl, .nt, .nq, .trig, .rdf, .owl, .jsonld"
    for command in (["validate", other], ["query", other, "where is", "Table_1"], ["diff", other, graph], convert):
        done = run(*command)
        assert done.code == 2
        assert done.err == f"usd2kg: {other}: {reason}; expected the same graph as one of {endings}\n"


def test_reads_classes_from_functional_syntax(run: Run, graph: Path):
    other = graph.with_suffix(".ofn")
    run("graph", "convert", graph, "-o", other)
    done = run("ontology", "show", other)
    assert done.code == 0
    assert "Table" in done.out
