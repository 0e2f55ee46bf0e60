"""Shipped lists of what belongs to the classes of public ontologies, and how they rank among other sources."""

import re
from pathlib import Path

import pytest

from tests.conftest import shared_file
from tests.grounding.records import make_class, make_object, make_scene, make_tbox
from usd2kg.grounding import ObjectView, Prediction, ground
from usd2kg.grounding.lexical.alignment import member_lists
from usd2kg.grounding.lexical.alignment.alignment_file import AlignmentFile
from usd2kg.grounding.lexical.alignment.alignment_rows import SHIPPED_LISTS, AlignmentRow, RowKind
from usd2kg.grounding.lexical.alignment.built_alignment import build_alignment
from usd2kg.grounding.lexical.alignment.member_lists import count_listed_classes, shipped_rows
from usd2kg.grounding.lexical.alignment.member_rows import ClassMembers, rows_of_members
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.knowledge import read_rows
from usd2kg.ontology import OntologyClass, TBox, load_home_tbox, load_tbox, read_registry
from usd2kg.ontology.model import local_name
from usd2kg.table_cache import TABLE_CACHE_VARIABLE

PUB = "https://pub.example/onto#"
OWN = "https://own.example/onto#"
LISTS = (
    ClassMembers(PUB + "Asset", ("vase", "umbrella", "flux capacitor", "hand mirror"), ("lamp",)),
    ClassMembers(PUB + "Stowset", ("rack", "shelf"), ("spice rack",)),
    ClassMembers(PUB + "Wearset", ("jacket", "safety vest", "quux warper"), ("umbrella", "towel")),
)
PUBLIC = (
    make_class("Asset", label="asset", base=PUB),
    make_class("Stowset", "Asset", label="stowset", base=PUB),
    make_class("Wearset", "Asset", label="wearset", base=PUB),
    make_class("Piano", "Asset", label="piano", base=PUB),
)
TBOX = make_tbox(*PUBLIC)


@pytest.fixture(autouse=True)
def lists(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ship `LISTS` for the classes of `PUB`, and no others."""
    monkeypatch.setenv(TABLE_CACHE_VARIABLE, "off")
    monkeypatch.setattr(
        member_lists, "_lists_for", lambda tbox: {one.class_iri: one for one in LISTS if one.class_iri in tbox.by_iri}
    )


def predict(names: str, tbox: TBox = TBOX, grounder: LexicalGrounder | None = None) -> list[Prediction]:
    scene = make_scene(*(make_object(f"/World/{name}") for name in names.split()))
    return list(ground(scene, tbox, grounder or LexicalGrounder()).predictions)


def classes_of(names: str, tbox: TBox = TBOX, grounder: LexicalGrounder | None = None) -> list[str]:
    return [(p.class_iri or "").rpartition("#")[2] for p in predict(names, tbox, grounder)]


def with_rows(text: str) -> LexicalGrounder:
    return LexicalGrounder(alignment=AlignmentFile(Path("rows.tsv"), text))


def by_model(**belongs: str) -> LexicalGrounder:
    """Return a grounder with the rows of a model that names one noun for each class."""
    members = [ClassMembers(PUB + name, (noun,), ()) for name, noun in belongs.items()]
    rows = rows_of_members(members, "test:model", TBOX, load_taxonomy())
    return with_rows(LexicalGrounder().format_alignment(TBOX, rows))


class TestGrounding:
    def test_nouns_and_what_is_below_them_are_in_the_class(self):
        names = "jacket_02 leather_jacket flux_capacitor bookshelf"
        assert classes_of(names) == ["Wearset", "Wearset", "Asset", "Stowset"]
        assert classes_of(names, grounder=LexicalGrounder(use_member_lists=False)) == ["Asset"] * 4

    def test_what_is_excluded_is_not_in_the_class_by_a_hypernym(self):
        assert classes_of("magazine_rack spice_rack") == ["Stowset", "Asset"]

    def test_the_explanation_names_the_list(self):
        (jacket,) = predict("jacket")
        assert jacket.explanation == "“jacket” is in the list of usd2kg a name for Wearset"

    def test_a_grounder_without_the_lists_says_so(self):
        assert LexicalGrounder(use_member_lists=False).settings["member_lists"] == "false"

    def test_the_answer_of_a_list_has_a_feature_of_its_own(self):
        views = [(f"/{name}", ObjectView(name=name)) for name in ("jacket", "leather_jacket", "asset")]
        assert [one.is_listed for one in LexicalGrounder().score_views(views, TBOX)] == [True, True, False]


class TestPrecedence:
    def test_a_label_comes_before_a_list(self):
        tbox = make_tbox(*PUBLIC, make_class("Jacket", "Asset", label="jacket", base=PUB))
        assert classes_of("jacket leather_jacket", tbox) == ["Jacket", "Jacket"]

    @pytest.mark.parametrize("name", ["vest", "safety_vest", "safety vest orange"])
    def test_a_more_specific_class_of_a_user_comes_before_a_list(self, name: str):
        vest = OntologyClass(OWN + "Vest", "vest", (), "", (PUB + "Wearset",))
        assert classes_of(name.replace(" ", "_"), make_tbox(*PUBLIC, vest)) == ["Vest"]

    def test_another_class_of_a_user_does_not(self):
        vest = OntologyClass(OWN + "Vest", "vest", (), "", (PUB + "Stowset",))
        assert classes_of("safety_vest", make_tbox(*PUBLIC, vest)) == ["Wearset"]

    def test_a_model_may_only_narrow_a_list(self):
        assert classes_of("umbrella jacket", grounder=by_model(Stowset="umbrella", Asset="jacket")) == [
            "Stowset",
            "Wearset",
        ]

    @pytest.mark.parametrize(
        ("class_name", "modifier", "found"), [("Stowset", "", "Stowset"), ("Wearset", "Not", "Asset")]
    )
    def test_a_person_has_the_last_word(self, class_name: str, modifier: str, found: str):
        columns = "subject_label\tpredicate_id\tpredicate_modifier\tobject_id\tmapping_justification"
        row = f"quux warper\tskos:exactMatch\t{modifier}\t{class_name}\tsemapv:ManualMappingCuration"
        assert classes_of("quux_warper") == ["Wearset"]
        assert classes_of("quux_warper", grounder=with_rows(f"{columns}\n{row}\n")) == [found]

    @pytest.mark.parametrize(
        ("noun", "name"), [("towel", "towel"), ("towel", "bath_towel"), ("piece of cloth", "towel")]
    )
    def test_a_persons_class_for_a_concept_lifts_exclusions_below_it(self, noun: str, name: str):
        columns = "subject_id\tsubject_label\tpredicate_id\tobject_id\tmapping_justification"
        concept = load_taxonomy().concept_iri(load_taxonomy().senses(noun.replace(" ", ""))[0].synset)
        row = f"{concept}\t{noun}\tskos:closeMatch\tWearset\tsemapv:ManualMappingCuration"
        assert classes_of(name) == ["Asset"]
        assert classes_of(name, grounder=with_rows(f"{columns}\n{row}\n")) == ["Wearset"]


class TestRows:
    def test_rows_say_where_they_come_from(self):
        lines = LexicalGrounder().format_alignment(TBOX).splitlines()
        (row,) = [line for line in lines if line.startswith("\tflux capacitor\t")]
        assert row.endswith("\t0.95\tshipped: reviewed list, it belongs to the class\tlisted\t")
        assert f"\tsemapv:BackgroundKnowledgeBasedMatching\t{SHIPPED_LISTS}\t" in row

    def test_a_file_gives_the_same_lexicon(self):
        taxonomy = load_taxonomy()
        built = build_alignment(TBOX, taxonomy, {})
        text = LexicalGrounder().format_alignment(TBOX)
        assert AlignmentFile(Path("x.tsv"), text).apply(TBOX, taxonomy, {}) == (built.tbox, built.edited(taxonomy))

    def test_a_concept_belongs_to_the_class_of_most_of_its_nouns(self):
        # All three mean one synset.
        members = [ClassMembers(PUB + "Stowset", ("couch",), ()), ClassMembers(PUB + "Asset", ("sofa", "lounge"), ())]
        assert concepts(members) == {"sofa": "Asset"}
        assert concepts([members[0], ClassMembers(PUB + "Asset", ("sofa",), ())]) == {"sofa": "Asset"}
        assert concepts([members[0], ClassMembers(PUB + "Asset", ("lounge",), ())]) == {"sofa": "Stowset"}

    @pytest.mark.parametrize(("noun", "labels"), [("flat", {"flat"}), ("flat#7", {"apartment"}), ("flat#0", set())])
    def test_a_number_selects_the_sense(self, noun: str, labels: set[str]):
        assert concepts([ClassMembers(PUB + "Asset", (noun,), ())]).keys() == labels


def concepts(members: list[ClassMembers]) -> dict[str, str]:
    rows: list[AlignmentRow] = list(rows_of_members(members, SHIPPED_LISTS, TBOX, load_taxonomy()))
    return {row.label: row.class_iri.removeprefix(PUB) for row in rows if row.kind is RowKind.CONCEPT}


class TestTable:
    @pytest.fixture(autouse=True)
    def lists(self) -> None:
        """Keep the lists that are shipped."""

    def test_the_home_ontology_and_others_have_no_lists(self):
        for tbox in (load_home_tbox(), make_tbox(make_class("Asset"))):
            built = build_alignment(tbox, load_taxonomy(), {})
            assert shipped_rows(built.tbox, built.lexicon, load_taxonomy()) == []
            assert built.edited(load_taxonomy()) is built.lexicon

    def test_lists_name_known_ontologies(self):
        assert count_listed_classes().keys() <= read_registry().keys()
        assert all(count > 5 for count in count_listed_classes().values())

    def test_no_noun_is_in_a_list_and_excluded_from_it(self):
        for row in read_rows("class_members.csv"):
            assert not set(row["things"].split("|")) & set(filter(None, row["not_things"].split("|"))), row["class"]

    def test_versions_with_another_namespace_share_the_lists(self):
        for version in ("IFC4/ADD2", "IFC4/ADD2_TC1"):
            door = make_class("IfcDoor", base=f"https://standards.buildingsmart.org/IFC/DEV/{version}/OWL#")
            built = build_alignment(make_tbox(door), load_taxonomy(), {})
            assert "revolving door" in {row.subject for row in built.rows if row.class_iri == door.iri}

    @pytest.mark.parametrize(
        ("name", "file"),
        [
            ("cco-artifacts", "cco/ArtifactOntology.ttl"),
            ("dogont", "dogont/dogont.owl"),
            ("rec", "rec/rec.ttl"),
            ("saref4bldg", "saref/saref4bldg.ttl"),
        ],
    )
    def test_classes_exist(self, name: str, file: str):
        ontology = load_tbox(shared_file(f"ontologies/other/{file}"))
        text = shared_file(f"ontologies/other/{file}").read_text("utf-8")
        listed = [row["class"] for row in read_rows("class_members.csv") if name in row["ontologies"].split("|")]
        # Some are outside the default scope, such as spaces.
        unknown = [iri for iri in listed if iri not in ontology.by_iri and not names_class(iri, text)]
        assert listed
        assert unknown == []


def names_class(iri: str, text: str) -> bool:
    """Return whether a document names a class, as an IRI or with a prefix."""
    return iri in text or re.search(rf":{re.escape(local_name(iri))}\b", text) is not None
