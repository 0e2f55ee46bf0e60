"""Alignment files: exact round trips, edits that change classes, and errors with their line."""

import csv
import io
import subprocess
from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from benchmarks.names.lists import PUBLIC_ONTOLOGIES, iter_ontology_lists
from tests.conftest import shared_file
from tests.grounding.records import make_class, make_object, make_scene, make_tbox
from tests.kitchen import kitchen_scene
from usd2kg import build
from usd2kg.errors import GroundingError
from usd2kg.grounding import ground
from usd2kg.grounding.lexical.alignment.alignment_file import AlignmentFile, format_alignment, read_alignment_file
from usd2kg.grounding.lexical.alignment.artificial_root import build_rooted_lexicon
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import TBox, load_tbox

VALIDATOR = Path(__file__).parents[2] / "build/sssom/bin/sssom"
GUITAR = "wn:03472449-n"
VASE = "wn:04529463-n"
SHOP = make_tbox(
    make_class("Item", label="item"),
    make_class("Stationery", "Item", label="stationery"),
    make_class("Media", "Item", label="media"),
    make_class("Furniture", "Item", label="furniture"),
)
HEADER = ("subject_id", "subject_label", "predicate_id", "object_id", "mapping_justification")


def write_edits(*rows: tuple[str, ...], columns: tuple[str, ...] = HEADER) -> AlignmentFile:
    """Return a file of a person: rows of the columns of `HEADER`."""
    lines = ["\t".join(cells) for cells in (columns, *rows)]
    return AlignmentFile(Path("edits.sssom.tsv"), "\n".join(lines) + "\n")


def edit(subject: str, label: str, class_name: str, predicate: str = "skos:closeMatch") -> tuple[str, ...]:
    return subject, label, predicate, class_name, "semapv:ManualMappingCuration"


def classes_of(names: str, tbox: TBox, alignment: AlignmentFile | None = None) -> list[str]:
    """Return the local names of the classes of some names."""
    scene = make_scene(*(make_object(f"/World/{name}") for name in names.split()))
    found = ground(scene, tbox, LexicalGrounder(alignment=alignment))
    return [tbox.by_iri[p.class_iri].local_name if p.class_iri else "" for p in found.predictions]


def check_round_trip(tbox: TBox) -> str:
    taxonomy, synonyms = load_taxonomy(), home_names()
    rooted, lexicon = build_rooted_lexicon(tbox, taxonomy, synonyms)
    text = format_alignment(rooted, lexicon, taxonomy)
    assert AlignmentFile(Path("x.tsv"), text).apply(tbox, taxonomy, synonyms) == (rooted, lexicon)
    return text


@pytest.fixture(scope="module")
def home_text(home_tbox: TBox) -> str:
    """The complete file of the home TBox."""
    return LexicalGrounder().format_alignment(home_tbox)


class TestRoundTrip:
    def test_the_home_tbox(self, home_tbox: TBox):
        check_round_trip(home_tbox)

    @pytest.mark.parametrize(
        "tbox",
        [
            SHOP,
            make_tbox(make_class("chair"), make_class("table"), make_class("otherprop")),
            make_tbox(make_class("chair"), make_class("table")),
        ],
        ids=["with a root", "residual class", "without a root"],
    )
    def test_small_tboxes(self, tbox: TBox):
        check_round_trip(tbox)

    def test_the_ontologies_of_the_benchmark(self):
        for tbox in {id(tbox): tbox for _, tbox in iter_ontology_lists(("train",), public=False)}.values():
            check_round_trip(tbox)

    @pytest.mark.parametrize("name", PUBLIC_ONTOLOGIES)
    def test_public_ontologies(self, name: str):
        check_round_trip(load_tbox(shared_file(f"ontologies/other/{PUBLIC_ONTOLOGIES[name]}")))

    @settings(deadline=None, max_examples=25)
    @given(st.lists(st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=20), min_size=1, max_size=4))
    @example(labels=["="])
    def test_any_labels(self, labels: list[str]):
        check_round_trip(make_tbox(*(make_class(f"C{at}", label=label) for at, label in enumerate(labels))))

    def test_classes_are_the_same(self, home_tbox: TBox, home_text: str, tmp_path: Path):
        scene = make_scene(*(make_object(f"/World/{obj.name}") for obj in kitchen_scene().objects[::5]))
        path = tmp_path / "home.sssom.tsv"
        path.write_text(home_text, encoding="utf-8")
        read = ground(scene, home_tbox, LexicalGrounder(alignment=read_alignment_file(path)))
        assert read.predictions == ground(scene, home_tbox).predictions


class TestText:
    TEXT = LexicalGrounder().format_alignment(SHOP)

    def rows(self) -> list[dict[str, str]]:
        body = "".join(line for line in self.TEXT.splitlines(keepends=True) if not line.startswith("#"))
        return list(csv.DictReader(io.StringIO(body), delimiter="\t"))

    def test_a_term_is_a_literal_with_its_kind(self):
        (row,) = [row for row in self.rows() if row["subject_label"] == "stationery" and not row["subject_id"]]
        assert (row["subject_type"], row["object_id"], row["confidence"]) == ("rdfs literal", "ns1:Stationery", "1")
        assert (row["term_kind"], row["comment"]) == ("label", "the label of the class")

    def test_a_concept_has_class_predicate_and_reason(self):
        found = [row for row in self.rows() if row["subject_label"] == "furniture" and row["subject_id"]]
        assert [(row["subject_id"], row["predicate_id"], row["object_id"]) for row in found] == [
            ("wn:03410635-n", "skos:exactMatch", "ns1:Furniture")
        ]
        assert found[0]["comment"] == "“furniture” is the label of the class"

    def test_a_kind_of_a_class_has_a_broader_match(self, home_text: str):
        lines = home_text.splitlines()
        rows = [line.split("\t") for line in lines if line.startswith((GUITAR, "wn:04077839-n", "\tguitar\t"))]
        assert [(row[1], row[3], row[6]) for row in rows] == [
            ("refrigerator", "skos:exactMatch", "refrigerator"),
            ("guitar", "skos:broadMatch", "artifact"),
            ("guitar", "skos:broadMatch", "artifact"),
        ]

    def test_a_category_member_has_a_broader_match(self):
        (row,) = [row for row in self.rows() if row["subject_label"] == "adhesive tape"]
        assert (row["predicate_id"], row["object_id"]) == ("skos:broadMatch", "ns1:Stationery")
        assert int(row["category_size"]) > 1

    def test_the_header_names_the_default_class(self):
        assert '#default_class: "ns1:Item"' in self.TEXT.splitlines()

    @pytest.mark.slow
    def test_the_reference_implementation_accepts_it(self, tmp_path: Path):
        if not VALIDATOR.exists():
            pytest.skip("needs sssom-py, see make sssom-check-env")
        path = tmp_path / "shop.sssom.tsv"
        path.write_text(self.TEXT, encoding="utf-8")
        subprocess.run([VALIDATOR, "validate", path], check=True, capture_output=True)
        subprocess.run([VALIDATOR, "parse", path, "-o", tmp_path / "parsed.tsv"], check=True, capture_output=True)


class TestEdits:
    def test_a_concept_takes_along_what_is_below_it(self):
        names = "violin electric_guitar guitar_red adhesive_tape"
        assert classes_of(names, SHOP) == ["Item", "Item", "Item", "Stationery"]
        edits = write_edits(edit(GUITAR, "guitar", "Media"))
        assert classes_of(names, SHOP, edits) == ["Item", "Media", "Media", "Stationery"]

    def test_names_of_the_home_vocabulary_yield(self, home_tbox: TBox):
        edits = write_edits(edit(GUITAR, "guitar", "soma:Tableware"))
        names = "guitar_red electric_guitar chair"
        assert classes_of(names, home_tbox) == ["DesignedArtifact", "DesignedArtifact", "DesignedChair"]
        assert classes_of(names, home_tbox, edits) == ["Tableware", "Tableware", "DesignedChair"]
        edits = write_edits(edit(VASE, "vase", "soma:Tableware", "skos:broadMatch"))
        assert classes_of("vase urn jar", home_tbox, edits) == ["Tableware", "Tableware", "Jar"]

    def test_labels_of_the_ontology_stay(self):
        edits = write_edits(edit("wn:03410635-n", "furniture", "Media"))
        assert classes_of("furniture chair", SHOP, edits) == ["Furniture", "Media"]

    def test_a_term(self):
        edits = write_edits(edit("", "Foo Bar", "Media"))
        assert classes_of("foo_bar_01", SHOP, edits) == ["Media"]

    def test_not_takes_a_row_back(self):
        columns = (*HEADER, "predicate_modifier")
        (tape,) = [line.split("\t")[0] for line in TestText.TEXT.splitlines() if "\tadhesive tape\t" in line]
        edits = write_edits((*edit(tape, "adhesive tape", "Stationery", "skos:broadMatch"), "Not"), columns=columns)
        assert classes_of("adhesive_tape", SHOP) == ["Stationery"]
        assert classes_of("adhesive_tape", SHOP, edits) == ["Item"]

    def test_a_deleted_row_of_a_complete_file_is_gone(self):
        taxonomy = load_taxonomy()
        lines = TestText.TEXT.splitlines(keepends=True)
        (row,) = [line for line in lines if "\tadhesive tape\t" in line]
        synset = taxonomy.find_concept(row.split("\t")[0].replace("wn:", "http://wordnet-rdf.princeton.edu/id/"))
        for kept in (lines, [line for line in lines if line != row]):
            _, lexicon = AlignmentFile(Path("x.tsv"), "".join(kept)).apply(SHOP, taxonomy, home_names())
            assert (synset in lexicon.category_members) == (row in kept)

    def test_an_edited_row_of_a_complete_file_decides(self):
        old, new = "semapv:LexicalMatching", "semapv:ManualMappingCuration"
        text = TestText.TEXT.replace("ns1:Furniture\tfurniture\t" + old, "ns1:Media\tfurniture\t" + new)
        assert text != TestText.TEXT
        assert classes_of("chair", SHOP, AlignmentFile(Path("x.tsv"), text)) == ["Media"]

    @pytest.mark.parametrize("subject", ["wn:03410635-n", ""], ids=["concept", "term"])
    def test_an_edited_class_suffices(self, subject: str):
        lines = TestText.TEXT.splitlines(keepends=True)
        (row,) = [line for line in lines if line.startswith(f"{subject}\tfurniture\t")]
        text = TestText.TEXT.replace(row, row.replace("ns1:Furniture", "ns1:Media"))
        name = "chair" if subject else "furniture"
        assert classes_of(name, SHOP, AlignmentFile(Path("x.tsv"), text)) == ["Media"]

    def test_an_edited_row_of_a_model_is_a_person_s(self):
        columns = (*HEADER, "mapping_tool")
        edits = write_edits((*edit(GUITAR, "guitar", "Media"), "some model"), columns=columns)
        assert classes_of("guitar_red", SHOP, edits) == ["Media"]

    @pytest.mark.parametrize("predicate", ["skos:exactMatch", "skos:closeMatch", "skos:broadMatch"])
    def test_any_predicate_decides(self, predicate: str):
        edits = write_edits(edit(GUITAR, "guitar", "Media", predicate))
        assert classes_of("guitar_red", SHOP, edits) == ["Media"]

    def test_a_spreadsheet_may_quote_the_header_and_fill_up_its_rows(self):
        file = io.StringIO(newline="")
        lines = TestText.TEXT.splitlines()
        width = max(line.count("\t") for line in lines)
        for line in lines:
            cells = [line] if line.startswith("#") else line.split("\t")
            csv.writer(file, delimiter="\t").writerow([*cells, *[""] * (width - len(cells) + 1)])
        assert file.getvalue().startswith('"#sssom_version: ""1.1"""\t')
        taxonomy, synonyms = load_taxonomy(), home_names()
        saved = AlignmentFile(Path("x.tsv"), file.getvalue()).apply(SHOP, taxonomy, synonyms)
        assert saved == build_rooted_lexicon(SHOP, taxonomy, synonyms)

    def test_the_explanation_says_so(self):
        scene = make_scene(make_object("/World/electric_guitar"))
        grounder = LexicalGrounder(alignment=write_edits(edit(GUITAR, "guitar", "Media")))
        (prediction,) = ground(scene, SHOP, grounder).predictions
        assert "which the alignment file puts in Media" in prediction.explanation

    def test_the_settings_have_its_hash(self):
        edits = write_edits(edit(GUITAR, "guitar", "Media"))
        assert LexicalGrounder(alignment=edits).settings["alignment"] == edits.digest
        assert "alignment" not in LexicalGrounder().settings


class TestBuild:
    def test_uses_a_file(self, home_tbox: TBox, tmp_path: Path):
        path = tmp_path / "edits.sssom.tsv"
        edits = write_edits(edit(VASE, "vase", "soma:Tableware"))
        path.write_text(edits.text, encoding="utf-8")
        scene = make_scene(make_object("/World/vase_empty_02"))
        grounding = build(scene, home_tbox, alignment=path).grounding
        assert grounding.settings["alignment"] == edits.digest
        (vase,) = grounding.predictions
        assert vase.class_iri is not None
        assert home_tbox.by_iri[vase.class_iri].local_name == "Tableware"

    @pytest.mark.parametrize(
        ("grounder", "message"),
        [
            ("volume", "grounder 'volume' takes no alignment; choose the grounder lexical"),
            (LexicalGrounder(), "the grounder is given as an object; expected its name to use the alignment"),
        ],
    )
    def test_other_grounders_take_none(self, grounder: LexicalGrounder | str, message: str):
        with pytest.raises(GroundingError, match=message):
            build(make_scene(make_object("/World/vase")), grounder=grounder, alignment="edits.sssom.tsv")


class TestErrors:
    @pytest.mark.parametrize(
        ("row", "message"),
        [
            (edit(GUITAR, "guitar", "Nope"), "line 2: .*'Nope' names no class of the 4 in scope"),
            (edit("wn:99999999-n", "guitar", "Media"), "line 2: .*99999999-n' is not a known concept"),
            (edit("https://x.example/guitar", "guitar", "Media"), "line 2: .*is not a known concept"),
            (edit(GUITAR, "guitar", "Media", "owl:sameAs"), "line 2: the predicate is 'owl:sameAs'; expected one of"),
            (edit("", "", "Media"), "line 2: has no subject"),
            (edit(GUITAR, "guitar", "sssom:NoTermFound"), "line 2: .*expected a class, or the predicate modifier Not"),
        ],
    )
    def test_a_bad_row_is_named_with_its_line(self, row: tuple[str, ...], message: str):
        with pytest.raises(GroundingError, match=rf"edits\.sssom\.tsv: {message}"):
            classes_of("guitar", SHOP, write_edits(row))

    @pytest.mark.parametrize(
        ("column", "value", "message"),
        [
            ("confidence", "1.5", "the confidence is '1.5'; expected a number above 0, at most 1"),
            ("confidence", "nan", "the confidence is 'nan'"),
            ("term_kind", "noun", "the term kind is 'noun'; expected one of label, synonym"),
            ("category_size", "-1", "the category size is '-1'; expected the number of concepts"),
            ("predicate_modifier", "Maybe", "the predicate modifier is 'Maybe'; expected Not"),
        ],
    )
    def test_a_bad_cell_is_named(self, column: str, value: str, message: str):
        edits = write_edits((*edit(GUITAR, "guitar", "Media"), value), columns=(*HEADER, column))
        with pytest.raises(GroundingError, match=f"line 2: {message}"):
            classes_of("guitar", SHOP, edits)

    @pytest.mark.parametrize(
        "rows",
        [
            (edit(GUITAR, "guitar", "Media"), edit(GUITAR, "guitar", "Furniture")),
            (edit("", "guitar", "Media"), edit("", "Guitar", "Furniture")),
        ],
        ids=["concept", "term"],
    )
    def test_two_classes_of_a_subject_are_named(self, rows: tuple[tuple[str, ...], ...]):
        with pytest.raises(GroundingError, match=r"line 3: '[Gg]uitar' has another class on line 2; leave one of them"):
            classes_of("guitar", SHOP, write_edits(*rows))

    def test_the_alignment_of_another_ontology_is_named(self, home_text: str):
        number = next(
            at for at, line in enumerate(home_text.splitlines(), start=1) if line.startswith("#default_class")
        )
        expected = (
            rf"x\.tsv: line {number}: .*#DesignedArtifact' names no class .*; the alignment was written for http:"
        )
        with pytest.raises(GroundingError, match=expected):
            classes_of("guitar", SHOP, AlignmentFile(Path("x.tsv"), home_text))

    def test_another_file_is_rejected(self):
        with pytest.raises(GroundingError, match="line 1 has no column subject_label; expected an alignment"):
            classes_of("guitar", SHOP, AlignmentFile(Path("x.csv"), "path,class\n/Guitar,Media\n"))

    def test_a_missing_file_is_an_error(self, tmp_path: Path):
        with pytest.raises(GroundingError, match=r"none\.tsv: cannot be read as an alignment"):
            read_alignment_file(tmp_path / "none.tsv")

    def test_another_version_of_the_ontology_is_a_warning(self, caplog: pytest.LogCaptureFixture):
        text = TestText.TEXT.replace(f'object_source_version: "{SHOP.content_hash}"', 'object_source_version: "old"')
        assert classes_of("chair", SHOP, AlignmentFile(Path("x.tsv"), text)) == ["Furniture"]
        assert "was written for another version of the ontology" in caplog.text
        assert "write it again with usd2kg ontology align, and copy the rows of people into it" in caplog.text

    def test_a_label_that_is_no_noun_for_its_concept_is_a_warning(self, caplog: pytest.LogCaptureFixture):
        assert classes_of("guitar_red", SHOP, write_edits(edit(GUITAR, "chair", "Media"))) == ["Media"]
        assert "edits.sssom.tsv: line 2: “chair” is no noun for http://wordnet-rdf" in caplog.text
        caplog.clear()
        assert classes_of("guitar_red", SHOP, write_edits(edit(GUITAR, "guitar", "Media"))) == ["Media"]
        assert not caplog.text

    def test_a_complete_file_with_edits_alone_is_a_warning(self, caplog: pytest.LogCaptureFixture):
        header = "".join(line for line in TestText.TEXT.splitlines(keepends=True) if line.startswith("#"))
        edits = AlignmentFile(Path("x.tsv"), header + write_edits(edit(GUITAR, "guitar", "Media")).text)
        assert classes_of("guitar", SHOP, edits) == ["Media"]
        assert "x.tsv: has a default_class, so it replaces the alignment that is built" in caplog.text
        assert "delete the line default_class" in caplog.text

    def test_a_complete_file_has_no_warning(self, caplog: pytest.LogCaptureFixture):
        assert classes_of("chair", SHOP, AlignmentFile(Path("x.tsv"), TestText.TEXT)) == ["Furniture"]
        assert not caplog.text
