"""SSSOM files: exact bytes, round trips through an independent reader, and reviews."""

import csv
import io
import json
import logging
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.records import LAB, make_class, make_tbox
from usd2kg.errors import GraphError, GroundingError
from usd2kg.graph import format_sssom
from usd2kg.graph.iris import individual_iri
from usd2kg.grounding import Candidate, Concept, Decision, Grounding, Prediction, Status, read_decisions
from usd2kg.grounding.decisions import make_decision
from usd2kg.grounding.sssom_file import cell_text, read_sssom_file

TBOX = make_tbox(make_class("Thing"), make_class("Cup", "Thing", label="cup"))
BASE = "https://my.lab/k/"
VALIDATOR = Path(__file__).parents[3] / "build/sssom/bin/sssom"

CUP = Prediction(
    "/Küche/Cup_1",
    LAB + "Cup",
    0.97,
    Status.GROUNDED,
    "lexical",
    "“cup” is\tthe label",
    ("name",),
    (Candidate(LAB + "Cup", 0.97), Candidate(LAB + "Thing", 0.1)),
)
CORRECTED = Prediction("/Küche/x", LAB + "Thing", 0.1, Status.SUPERCLASS, "lexical", "nothing is known").reviewed(
    LAB + "Cup", "Ann | Bob", confidence=0.9, comment="it is one", time="2026-07-15T12:00:00Z"
)
CONFIRMED = replace(CUP, prim_path="/Küche/c").reviewed(LAB + "Cup", "https://orcid.org/0000-0001-2345-6789")
NO_CLASS = Prediction("/Küche/y", None, None, Status.REFUSED, "dictionary", "not in the dictionary")
LOST = Prediction("/Küche/z", None, None, Status.MISSING, "lexical", "no such prim")


def make_grounding(*predictions: Prediction) -> Grounding:
    return Grounding(
        "room.usda", "sha256:1", "https://lab.example/onto", "sha256:2", "lexical", {}, False, "0.1.0", predictions
    )


def rows_of(text: str) -> list[dict[str, str]]:
    """Return the rows as parsed by the csv module."""
    body = io.StringIO("".join(line for line in text.splitlines(keepends=True) if not line.startswith("#")), newline="")
    return list(csv.DictReader(body, delimiter="\t"))


def header_of(text: str) -> dict[str, str]:
    lines = [line[1:] for line in text.splitlines() if line.startswith("#") and '": ' not in line and ': "' in line]
    return {name.strip(): json.loads(value) for name, value in (line.split(": ", 1) for line in lines)}


def test_the_header_names_source_and_tool():
    text = format_sssom(
        make_grounding(CUP), TBOX, {}, base=BASE, license_iri="https://x.org/l", mapping_date="2026-07-15"
    )
    head = header_of(text)
    assert text.startswith('#sssom_version: "1.1"\n#curie_map:\n')
    assert head["mapping_set_id"] == "https://my.lab/k/-mapping"
    assert (head["mapping_tool"], head["mapping_tool_version"]) == ("usd2kg", "0.1.0")
    assert (head["license"], head["mapping_date"]) == ("https://x.org/l", "2026-07-15")
    assert head["scene"] == BASE
    assert head["subject_source"] == "scene:-stage"
    assert head["subject_source_version"] == "sha256:1"


def test_rows_match_the_graph():
    (row,) = rows_of(format_sssom(make_grounding(CUP), TBOX, {CUP.prim_path: "Mug\t1"}, base=BASE))
    head = header_of(format_sssom(make_grounding(CUP), TBOX, {}, base=BASE))
    assert row["subject_id"] == "scene:K%C3%BCche.Cup_1"
    assert head["scene"] + row["subject_id"].removeprefix("scene:") == individual_iri(BASE, CUP.prim_path)
    prefix, _, name = row["object_id"].partition(":")
    assert head[prefix] + name == LAB + "Cup"
    assert (row["subject_label"], row["object_label"], row["predicate_id"]) == ("Mug 1", "cup", "rdf:type")
    assert (row["mapping_justification"], row["confidence"]) == ("semapv:CompositeMatching", "0.9700")
    assert (row["comment"], row["prim_path"]) == ("“cup” is the label", "/Küche/Cup_1")
    assert row["alternatives"].endswith(":Thing")


def test_reviewers_are_named_and_unanswered_objects_have_no_row():
    rows = rows_of(format_sssom(make_grounding(CORRECTED, CONFIRMED, NO_CLASS, LOST), TBOX, {}, base=BASE))
    assert [row["prim_path"] for row in rows] == ["/Küche/x", "/Küche/c", "/Küche/y"]
    corrected, confirmed, refused = rows
    assert corrected["mapping_justification"] == "semapv:ManualMappingCuration"
    assert (corrected["reviewer_label"], corrected["review_date"]) == (r"Ann \| Bob", "2026-07-15")
    assert corrected["comment"] == "nothing is known; it is one"
    assert confirmed["reviewer_id"] == "orcid:0000-0001-2345-6789"
    assert confirmed["mapping_justification"] == "semapv:CompositeMatching"
    assert (refused["object_id"], refused["confidence"]) == ("sssom:NoTermFound", "")


def test_without_a_date_the_bytes_are_the_same():
    first, second = (format_sssom(make_grounding(CUP, CORRECTED), TBOX, {}) for _ in range(2))
    assert first == second
    assert "mapping_date" not in first
    assert "license/unspecified" in first


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"base": "no iri"}, "base 'no iri'"),
        ({"license_iri": "mine"}, "license 'mine': expected an IRI"),
        ({"mapping_date": "today"}, "mapping date 'today'.*expected one like 2026-07-15"),
    ],
)
def test_wrong_options_are_one_line(options: dict[str, str], message: str):
    with pytest.raises(GraphError, match=message):
        format_sssom(make_grounding(CUP), TBOX, {}, **options)  # type: ignore[arg-type]


ANY_TEXT = st.text(st.characters(exclude_characters="\r\x00", exclude_categories=["Cs"]), min_size=1, max_size=20)


@settings(deadline=None, max_examples=100)
@given(ANY_TEXT, ANY_TEXT, ANY_TEXT)
def test_any_text_survives(path: str, label: str, comment: str):
    prediction = replace(CUP, prim_path=f"/{path}", explanation=comment)
    text = format_sssom(make_grounding(prediction), TBOX, {f"/{path}": label}, base=BASE)
    start = text.index("subject_id\t")
    (row,) = csv.DictReader(io.StringIO(text[start:], newline=""), delimiter="\t")
    assert row["prim_path"] == f"/{path}"
    assert row["subject_label"] == cell_text(label)
    assert row["comment"] == cell_text(comment)
    assert row["subject_id"].removeprefix("scene:") == individual_iri("", f"/{path}")


def test_names_control_no_terminal_and_no_spreadsheet(tmp_path: Path):
    prediction = replace(CUP, explanation="=HYPERLINK(1)", status=Status.REVIEWED)
    text = format_sssom(make_grounding(prediction), TBOX, {CUP.prim_path: "cup\x1b[2J\x9b\u202e"}, base=BASE)
    start = text.index("subject_id\t")
    (row,) = csv.DictReader(io.StringIO(text[start:], newline=""), delimiter="\t")
    assert row["subject_label"] == "cup\ufffd[2J\ufffd\ufffd"
    assert row["comment"] == "'=HYPERLINK(1)"
    (read,) = read_sssom_file(tmp_path / "a.tsv", text, ("comment",), "").rows
    assert read.cells["comment"] == "=HYPERLINK(1)"


class TestReadingBack:
    def write(self, folder: Path, *predictions: Prediction) -> Path:
        path = folder / "mapping.sssom.tsv"
        path.write_text(format_sssom(make_grounding(*predictions), TBOX, {}), encoding="utf-8")
        return path

    def test_only_reviewed_rows_are_decisions(self, tmp_path: Path):
        by_hand = make_decision("/Küche/h", LAB + "Thing")
        path = self.write(tmp_path, CUP, CORRECTED, CONFIRMED, NO_CLASS, by_hand)
        assert read_decisions(path, TBOX) == {
            "/Küche/x": Decision(LAB + "Cup", "Ann | Bob", time="2026-07-15"),
            "/Küche/c": Decision(LAB + "Cup", "https://orcid.org/0000-0001-2345-6789"),
            "/Küche/h": Decision(LAB + "Thing"),
        }

    def test_warns_if_no_row_is_a_decision(self, tmp_path: Path, caplog: pytest.LogCaptureFixture):
        with caplog.at_level(logging.WARNING):
            assert read_decisions(self.write(tmp_path, CUP), TBOX) == {}
        assert "none of its 1 rows was decided by a person" in caplog.text

    def test_a_file_with_other_prefixes_and_spaces_in_its_header(self, tmp_path: Path):
        path = tmp_path / "m.tsv"
        path.write_text(
            "# curie_map:\n#   l: 'https://lab.example/onto#'\n# license: https://x.org/\n"
            "prim_path\tpredicate_id\tobject_id\tmapping_justification\tpredicate_modifier\treviewer_label\n"
            "/a\trdf:type\tl:Cup\tsemapv:ManualMappingCuration\t\t\n"
            "/b\trdf:type\tl:Cup\tsemapv:ManualMappingCuration\tNot\t\n"
            "/c\thttp://www.w3.org/1999/02/22-rdf-syntax-ns#type\tThing\tsemapv:LexicalMatching\t\tAnn\n",
            encoding="utf-8",
        )
        assert read_decisions(path, TBOX) == {"/a": Decision(LAB + "Cup"), "/c": Decision(LAB + "Thing", "Ann")}

    @pytest.mark.parametrize(
        ("body", "message"),
        [
            ("", "line 1 has no column prim_path; expected SSSOM/TSV"),
            ("prim_path\tpredicate_id\tobject_id\n", "line 1 has no column mapping_justification"),
            (
                "{head}/a\trdf:type\tCup\tManualMappingCuration\n/a\trdf:type\tThing\tManualMappingCuration\n",
                "line 3.*two",
            ),
            ("{head}/a\tskos:exactMatch\tCup\tManualMappingCuration\n", "line 2: the predicate is 'skos:exactMatch'"),
            ("{head}/a\trdf:type\tUnicorn\tManualMappingCuration\n", "line 2: .*Unicorn"),
            ("{head}\trdf:type\tCup\tManualMappingCuration\n", "line 2: prim_path is empty"),
            ('{head}/a\trdf:type\t"Cup\tManualMappingCuration\n', "is not TSV"),
        ],
    )
    def test_errors_name_the_line(self, tmp_path: Path, body: str, message: str):
        path = tmp_path / "m.sssom.tsv"
        head = "prim_path\tpredicate_id\tobject_id\tmapping_justification\n"
        path.write_text(body.replace("{head}", head), encoding="utf-8")
        with pytest.raises(GroundingError, match=message):
            read_decisions(path, TBOX)


@pytest.mark.slow
@pytest.mark.skipif(not VALIDATOR.exists(), reason="needs the reference implementation; run make sssom-check-env")
class TestReferenceImplementation:
    def test_it_finds_our_files_valid(self, tmp_path: Path):
        hostile = replace(CUP, prim_path="/a b/Cup-1.b[3]", explanation='a "b" | c\n=1+1 #x')
        names = {hostile.prim_path: 'x "y"\t\n#z | =cmd'}
        path = tmp_path / "mapping.sssom.tsv"
        grounding = make_grounding(CUP, hostile, CORRECTED, CONFIRMED, NO_CLASS)
        path.write_text(format_sssom(grounding, TBOX, names, mapping_date="2026-07-15"), encoding="utf-8")
        done = subprocess.run([VALIDATOR, "validate", path], capture_output=True, text=True, timeout=300, check=False)
        assert done.returncode == 0, done.stderr

    def test_it_reads_the_same_rows(self, tmp_path: Path):
        path, again = tmp_path / "mapping.sssom.tsv", tmp_path / "again.sssom.tsv"
        text = format_sssom(make_grounding(CUP, CORRECTED, CONFIRMED, NO_CLASS), TBOX, {}, base=BASE)
        path.write_text(text, encoding="utf-8")
        subprocess.run([VALIDATOR, "parse", path, "-o", again], check=True, capture_output=True, timeout=300)
        columns = ("subject_id", "predicate_id", "object_id", "mapping_justification", "subject_label", "comment")
        found = {tuple(row[name] for name in columns) for row in rows_of(again.read_text("utf-8"))}
        assert found == {tuple(row[name] for name in columns) for row in rows_of(text)}

    def test_it_finds_a_broken_file_invalid(self, tmp_path: Path):
        path = tmp_path / "mapping.sssom.tsv"
        text = format_sssom(make_grounding(CUP), TBOX, {}, base=BASE).replace("semapv:CompositeMatching", "guess:x")
        path.write_text(text, encoding="utf-8")
        done = subprocess.run([VALIDATOR, "validate", path], capture_output=True, text=True, timeout=300, check=False)
        assert done.returncode != 0


def test_concepts_are_extension_columns():
    mug = Concept("http://wordnet-rdf.princeton.edu/id/03802912-n", "mug")
    grounding = make_grounding(replace(CUP, concept=mug.iri, concept_confidence=0.9), NO_CLASS)
    text = format_sssom(replace(grounding, concepts={mug.iri: mug}), TBOX, {}, base=BASE)
    first, second = rows_of(text)
    assert (first["concept"], first["concept_label"], first["concept_confidence"]) == ("wn:03802912-n", "mug", "0.9000")
    assert (second["concept"], second["concept_label"], second["concept_confidence"]) == ("", "", "")
    assert '#  wn: "http://wordnet-rdf.princeton.edu/id/"' in text.splitlines()
    assert [line for line in text.splitlines() if "concept_label" in line or "prefLabel" in line][:2] == [
        "#- slot_name: concept_label",
        "#  property: skos:prefLabel",
    ]
