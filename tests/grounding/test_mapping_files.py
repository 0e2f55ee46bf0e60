"""Files of groundings: CSV, JSON and lists of paths."""

import csv
import io
import json
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.records import LAB, make_class, make_tbox
from usd2kg.errors import GroundingError
from usd2kg.grounding import (
    Candidate,
    Concept,
    Decision,
    Grounding,
    Prediction,
    Review,
    Status,
    format_mapping,
    read_decisions,
    read_grounding,
    read_paths,
)

TBOX = make_tbox(make_class("Thing"), make_class("Cup", "Thing", label='cup, "tall"'))


def make_grounding(*predictions: Prediction) -> Grounding:
    return Grounding(
        scene="room.usda",
        scene_hash="sha256:1",
        ontology="https://lab.example/onto",
        ontology_hash="sha256:2",
        grounder="lexical",
        settings={"regime": "semantic", "evidence": "name"},
        is_calibrated=False,
        tool_version="0.1.0",
        predictions=predictions,
    )


SMALL = make_grounding(
    Prediction(
        "/Küche/Cup_1",
        LAB + "Cup",
        0.97,
        Status.GROUNDED,
        "lexical",
        "“cup” is the label",
        ("name",),
        (Candidate(LAB + "Cup", 0.97), Candidate(LAB + "Thing", 0.123456789)),
    ),
    Prediction("/Küche/x", LAB + "Thing", 0.1, Status.SUPERCLASS, "lexical", "nothing is known"),
    Prediction("/Küche/y", None, None, Status.REFUSED, "dictionary", "not in the dictionary"),
    Prediction("/Küche/z", None, None, Status.MISSING, "lexical", "no such prim"),
)
REVIEWED = SMALL.predictions[1].reviewed(
    LAB + "Cup",
    "https://orcid.org/0000-0001-2345-6789",
    confidence=0.9,
    comment="it is one",
    time="2026-07-15T12:00:00Z",
)


HEADER = "path,class,label,confidence,status,grounder,concept,concept_label,concept_confidence\n"
WORDNET = "https://lab.example/wn#"
WITH_CONCEPT = replace(
    make_grounding(
        Prediction(
            "/Küche/y",
            None,
            None,
            Status.REFUSED,
            "lexical",
            "no class",
            words=("coffee", "mug"),
            concept=WORDNET + "mug",
            concept_confidence=0.8,
        )
    ),
    concepts={
        WORDNET + "drinking_vessel": Concept(WORDNET + "drinking_vessel", "drinking vessel"),
        WORDNET + "mug": Concept(WORDNET + "mug", "mug", (WORDNET + "drinking_vessel",)),
    },
)


class TestCsv:
    def test_writes_the_expected_bytes(self):
        assert format_mapping(SMALL, TBOX, "csv") == (
            HEADER + '/Küche/Cup_1,https://lab.example/onto#Cup,"cup, ""tall""",0.9700,grounded,lexical,,,\n'
            "/Küche/x,https://lab.example/onto#Thing,Thing,0.1000,superclass,lexical,,,\n"
            "/Küche/y,,,,refused,dictionary,,,\n"
            "/Küche/z,,,,missing,lexical,,,\n"
        )

    def test_writes_concepts(self):
        assert format_mapping(WITH_CONCEPT, TBOX, "csv") == (
            HEADER + "/Küche/y,,,,refused,lexical,https://lab.example/wn#mug,mug,0.8000\n"
        )

    def test_writes_the_header_without_predictions(self):
        assert format_mapping(make_grounding(), TBOX, "csv") == HEADER

    @settings(deadline=None, max_examples=80)
    @given(st.text(st.characters(exclude_characters="\r\x00", exclude_categories=["Cs"]), min_size=1, max_size=30))
    def test_round_trips_any_path_and_label(self, text: str):
        tbox = make_tbox(make_class("Thing", label=text))
        grounding = make_grounding(Prediction(text, LAB + "Thing", 1.0, Status.GROUNDED, "lexical", ""))
        rows = list(csv.DictReader(io.StringIO(format_mapping(grounding, tbox, "csv"), newline="")))
        assert [(row["path"], row["label"]) for row in rows] == [(text, text)]


class TestJson:
    def test_reads_reviews_and_files_without_them(self, tmp_path: Path):
        path = tmp_path / "mapping.json"
        text = format_mapping(make_grounding(REVIEWED), TBOX, "json")
        path.write_text(text, encoding="utf-8")
        assert read_grounding(path).predictions == (REVIEWED,)
        data = json.loads(text)
        del data["predictions"][0]["review"]
        path.write_text(json.dumps(data), encoding="utf-8")
        assert read_grounding(path).predictions[0].review is None

    def test_reads_concepts_and_files_without_them(self, tmp_path: Path):
        path = tmp_path / "mapping.json"
        text = format_mapping(WITH_CONCEPT, TBOX, "json")
        path.write_text(text, encoding="utf-8")
        assert read_grounding(path) == WITH_CONCEPT
        data = json.loads(text)
        del data["concepts"]
        for name in ("words", "concept", "concept_confidence"):
            del data["predictions"][0][name]
        path.write_text(json.dumps(data), encoding="utf-8")
        found = read_grounding(path)
        assert (found.concepts, found.predictions[0].words, found.predictions[0].concept) == ({}, (), None)

    def test_rejects_deeply_nested_json(self, tmp_path: Path):
        path = tmp_path / "deep.json"
        path.write_text("[" * 200_000, encoding="utf-8")
        with pytest.raises(GroundingError, match=r"deep\.json: cannot be read as a grounding"):
            read_grounding(path)

    def test_restores_the_types_of_the_records(self, tmp_path: Path):
        path = tmp_path / "mapping.json"
        path.write_text(format_mapping(SMALL, TBOX, "json"), encoding="utf-8")
        first = read_grounding(path).predictions[0]
        assert isinstance(first.status, Status)
        assert isinstance(first.candidates[0], Candidate)
        assert isinstance(first.evidence, tuple)

    def test_writes_the_format_and_plain_values(self):
        data = json.loads(format_mapping(SMALL, TBOX, "json"))
        assert data["format"] == "usd2kg-grounding/1"
        assert data["predictions"][0]["status"] == "grounded"
        assert data["predictions"][2]["class_iri"] is None

    def test_ends_with_one_newline(self):
        text = format_mapping(SMALL, TBOX, "json")
        assert text.endswith("}\n")
        assert "Küche" in text

    @settings(deadline=None, max_examples=60)
    @given(
        st.text(st.characters(exclude_categories=["Cs"]), max_size=30),
        st.floats(0, 1),
        st.sampled_from(list(Status)),
        st.dictionaries(st.text("abc"), st.text("xyz"), max_size=3),
    )
    def test_round_trips_any_grounding(
        self, tmp_path_factory: pytest.TempPathFactory, text: str, score: float, status: Status, options: dict[str, str]
    ):
        prediction = Prediction(text, text, score, status, text, text, (text,), (Candidate(text, score),))
        grounding = Grounding(text, "", "", "", "", options, True, "", (prediction,))
        path = tmp_path_factory.getbasetemp() / "any.json"
        path.write_text(format_mapping(grounding, TBOX, "json"), encoding="utf-8")
        assert read_grounding(path) == grounding

    @pytest.mark.parametrize(
        "text",
        [
            "",
            "path,class\n",
            "[]",
            "null",
            "{}",
            '{"format": "usd2kg-grounding/2", "predictions": []}',
            '{"format": "usd2kg-grounding/1"}',
            '{"format": "usd2kg-grounding/1", "predictions": [], "unknown": 1}',
            '{"format": "usd2kg-grounding/1", "predictions": [{}]}',
            '{"format": "usd2kg-grounding/1", "predictions": 7}',
        ],
    )
    def test_rejects_other_json(self, tmp_path: Path, text: str):
        path = tmp_path / "mapping.json"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(GroundingError) as error:
            read_grounding(path)
        assert str(path) in str(error.value)
        assert "--format json" in str(error.value)

    def test_rejects_an_unknown_status(self, tmp_path: Path):
        path = tmp_path / "mapping.json"
        path.write_text(format_mapping(SMALL, TBOX, "json").replace('"refused"', '"shy"'), encoding="utf-8")
        with pytest.raises(GroundingError, match="shy"):
            read_grounding(path)

    def test_reports_a_missing_file(self, tmp_path: Path):
        with pytest.raises(GroundingError, match=r"none\.json"):
            read_grounding(tmp_path / "none.json")


class TestReview:
    def test_keeps_what_was_predicted(self):
        assert (REVIEWED.class_iri, REVIEWED.confidence, REVIEWED.status) == (LAB + "Cup", 0.9, Status.REVIEWED)
        assert REVIEWED.review == Review(
            reviewer="https://orcid.org/0000-0001-2345-6789",
            predicted_class=LAB + "Thing",
            predicted_confidence=0.1,
            predicted_status=Status.SUPERCLASS,
            comment="it is one",
            time="2026-07-15T12:00:00Z",
        )
        assert (REVIEWED.grounder, REVIEWED.explanation) == ("lexical", "nothing is known")

    def test_a_second_review_keeps_the_prediction_not_the_first_review(self):
        again = REVIEWED.reviewed(None, "Ada", comment="no class fits")
        assert (again.class_iri, again.confidence, again.status) == (None, None, Status.REVIEWED)
        assert again.review is not None
        assert (again.review.reviewer, again.review.comment, again.review.time) == ("Ada", "no class fits", "")
        assert (again.review.predicted_class, again.review.predicted_status) == (LAB + "Thing", Status.SUPERCLASS)


def test_rejects_an_unknown_format():
    with pytest.raises(GroundingError, match="format 'xlsx' is unknown; expected one of csv, json"):
        format_mapping(SMALL, TBOX, "xlsx")


class TestPaths:
    def read(self, folder: Path, data: str | bytes) -> list[str]:
        path = folder / "paths.csv"
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return read_paths(path)

    @pytest.mark.parametrize(
        ("text", "paths"),
        [
            ("path\n/b\n/a\n", ["/b", "/a"]),
            ("path\r\n/b\r\n/a\r\n", ["/b", "/a"]),
            ("path\n/a", ["/a"]),
            ("\ufeffpath,class,also\n/a,Cup,\n/b,Oven,Stove\n", ["/a", "/b"]),
            ("class,path\nCup,/a\n", ["/a"]),
            # Duplicates, blanks and empty cells.
            ("path\n/a\n\n/b\n/a\n", ["/a", "/b"]),
            ('path,note\n /a ,"x"\n,empty\n', ["/a"]),
            ("path\n", []),
            ("path\n/Küche/杯子\n", ["/Küche/杯子"]),
        ],
    )
    def test_reads_the_column_path_in_order_without_duplicates(self, tmp_path: Path, text: str, paths: list[str]):
        assert self.read(tmp_path, text) == paths

    @pytest.mark.parametrize(("text", "found"), [("", "nothing"), ("/a\n/b\n", "/a"), ("Path\n/a\n", "Path")])
    def test_rejects_a_file_without_the_column(self, tmp_path: Path, text: str, found: str):
        with pytest.raises(GroundingError) as error:
            self.read(tmp_path, text)
        assert "expected a column 'path'" in str(error.value)
        assert f"has the columns {found}" in str(error.value)

    def test_reports_a_missing_or_binary_file(self, tmp_path: Path):
        with pytest.raises(GroundingError, match=r"none\.csv: cannot be read"):
            read_paths(tmp_path / "none.csv")
        with pytest.raises(GroundingError, match=r"paths\.csv: cannot be read"):
            self.read(tmp_path, b"path\n\xff\xff\n")

    def test_reports_an_unclosed_quote(self, tmp_path: Path):
        # The rest of the file is one field, longer than the csv module allows (131,072 characters).
        with pytest.raises(GroundingError, match=r"paths\.csv"):
            self.read(tmp_path, 'path\n"/a\n' + "/Room/Cup\n" * 20_000)


def test_paths_of_files_may_be_text(tmp_path: Path):
    grounding, table = tmp_path / "grounding.json", tmp_path / "table.csv"
    grounding.write_text(format_mapping(SMALL, TBOX, "json"), "utf-8")
    table.write_text(f"path,class\n/a,{LAB}Cup\n", "utf-8")
    assert read_grounding(str(grounding)) == SMALL
    assert read_paths(str(table)) == ["/a"]
    assert read_decisions(str(table), TBOX) == {"/a": Decision(LAB + "Cup")}
