"""What is added to WordNet: new meanings, further kinds, and another order of meanings."""

import pytest

from tools.build_wordnet import Kinds, Synset, build_columns
from tools.data_files import read_source_rows
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy


def taxonomy_of(rows: dict[str, str]) -> Taxonomy:
    """Return a small taxonomy with what the rows add."""
    synsets = [
        Synset("artifact", [], [("artifact", 1)]),
        Synset("artifact", [0], [("lamp", 1), ("bulb", 2)]),
        Synset("artifact", [0], [("furniture", 1)]),
        Synset("plant", [], [("bulb", 1)]),
        Synset("artifact", [2], [("rack", 1), ("stand", 1)]),
        Synset("person", [], [("person", 1)]),
        Synset("top", [0], [("kit", 1)]),
        Synset("substance", [], [("clay", 1)]),
    ]
    Kinds(synsets).add_all([(name, kind.split("|")) for name, kind in rows.items()])
    return Taxonomy(build_columns([], synsets))


def chains(taxonomy: Taxonomy, lemma: str) -> list[list[str]]:
    """Return for each meaning, the usual one first, the names of all that is above it."""
    return [[taxonomy.name(up) for up, _ in taxonomy.walk_up(sense.synset)] for sense in taxonomy.senses(lemma)]


def test_a_name_gets_a_meaning_of_its_kinds():
    taxonomy = taxonomy_of({"torchiere": "lamp|furniture"})
    assert chains(taxonomy, "torchiere") == [["torchiere", "lamp", "furniture", "artifact"]]
    assert taxonomy.senses("torchiere")[0].domain == "artifact"


def test_a_new_meaning_comes_before_those_of_wordnet():
    taxonomy = taxonomy_of({"rack": "lamp"})
    assert chains(taxonomy, "rack") == [["rack", "lamp", "artifact"], ["rack", "furniture", "artifact"]]


def test_what_a_thing_is_too_is_added_once():
    taxonomy = taxonomy_of({"rack": "+lamp|+furniture"})
    assert chains(taxonomy, "rack") == [["rack", "furniture", "lamp", "artifact"]]
    # Nothing is above itself.
    assert chains(taxonomy_of({"artifact": "+rack"}), "artifact") == [["artifact"]]


def test_what_a_thing_is_not_is_taken_away():
    assert chains(taxonomy_of({"rack": "-furniture"}), "rack") == [["rack"]]
    with pytest.raises(ValueError, match="'rack,-lamp': WordNet does not have"):
        taxonomy_of({"rack": "-lamp"})
    # WordNet has wheeled vehicles below the containers.
    assert "container" not in chains(load_taxonomy(), "forklift")[0]


def test_another_meaning_may_be_the_usual_one():
    assert [sense.domain for sense in taxonomy_of({}).senses("bulb")] == ["plant", "artifact"]
    assert [sense.domain for sense in taxonomy_of({"bulb": "=2"}).senses("bulb")] == ["artifact", "plant"]


def test_a_kind_is_meant_as_an_artifact_unless_its_number_is_given():
    assert chains(taxonomy_of({"edison": "bulb"}), "edison") == [["edison", "lamp", "artifact"]]
    assert chains(taxonomy_of({"tulip": "bulb.1"}), "tulip") == [["tulip", "bulb"]]


def test_a_kind_is_meant_as_the_rows_have_it():
    # A rack is a lamp here, first of all; so is the wall rack, whichever row comes first.
    expected = ["rack", "lamp", "artifact"]
    assert chains(taxonomy_of({"rack": "lamp", "wall rack": "rack"}), "wallrack") == [["wall rack", *expected]]
    assert chains(taxonomy_of({"wall rack": "rack", "rack": "lamp"}), "wallrack") == [["wall rack", *expected]]
    assert chains(taxonomy_of({"wall rack": "rack.1", "rack": "lamp"}), "wallrack") == [
        ["wall rack", "rack", "furniture", "artifact"]
    ]
    # Workers are people, and not the ants that WordNet has beside them.
    assert chains(load_taxonomy(), "flightattendant")[0][1] != "insect"


def test_rows_that_speak_of_each_other_mean_what_wordnet_has():
    taxonomy = taxonomy_of({"rack": "stand", "stand": "rack"})
    assert {up for chain in chains(taxonomy, "rack") for up in chain} >= {"rack", "furniture"}


def test_a_row_may_speak_of_another_whichever_comes_first():
    taxonomy = taxonomy_of({"arc lamp": "floor lamp", "floor lamp": "lamp", "standing lamp": "==floor lamp"})
    assert chains(taxonomy, "arclamp") == [["arc lamp", "floor lamp", "lamp", "artifact"]]
    assert chains(taxonomy, "standinglamp") == [["floor lamp", "lamp", "artifact"]]


def test_a_name_with_meanings_may_be_another_word_first_of_all():
    assert chains(taxonomy_of({"rack": "==lamp"}), "rack") == [["lamp", "artifact"], ["rack", "furniture", "artifact"]]


def test_people_are_a_domain_of_their_own():
    assert [sense.domain for sense in taxonomy_of({"jogger": "person"}).senses("jogger")] == ["person"]
    assert chains(load_taxonomy(), "pedestrian")[0][:2] == ["pedestrian", "person"]


def test_what_is_made_is_an_artifact_though_its_kind_is_a_unit_or_a_substance():
    assert taxonomy_of({"office kit": "kit"}).senses("officekit")[0].domain == "artifact"
    assert taxonomy_of({"brick": "clay|furniture"}).senses("brick")[0].domain == "artifact"
    assert taxonomy_of({"mud": "clay"}).senses("mud")[0].domain == "substance"
    assert taxonomy_of({"onion": "bulb.1|furniture"}).senses("onion")[0].domain == "plant"
    assert load_taxonomy().senses("holepunch")[0].domain == "artifact"


def test_an_unknown_kind_is_an_error():
    with pytest.raises(ValueError, match="'rack': 'qwrtz' is no noun"):
        taxonomy_of({"rack": "qwrtz"})
    with pytest.raises(ValueError, match="speaks of itself in the end"):
        taxonomy_of({"arc lamp": "floor lamp", "floor lamp": "arc lamp"})


@pytest.mark.parametrize(
    ("lemma", "kind"), [("rangehood", "kitchen appliance"), ("stovetop", "stove"), ("chandelier", "lamp")]
)
def test_the_shipped_taxonomy_has_them(lemma: str, kind: str):
    assert kind in chains(load_taxonomy(), lemma)[0]


@pytest.mark.parametrize(
    ("lemma", "kind", "other"),
    [
        ("cheese cracker", "snack food", "firecracker"),
        ("sandwich spread", "condiment", "ranch"),
        ("vitamin tablet", "dietary supplement", "portable computer"),
        ("police horse", "animal", "gymnastic horse"),
        ("arm sling", "orthosis", "slingshot"),
        ("chemical drum", "barrel", "percussion instrument"),
        ("ice cream tub", "container", "bathtub"),
        ("battenberg", "baked goods", "block"),
        ("security tag", "security device", "rag"),
    ],
)
def test_its_kinds_are_meant_as_they_are_for_such_a_thing(lemma: str, kind: str, other: str):
    usual = chains(load_taxonomy(), lemma.replace(" ", ""))[0]
    assert kind in usual
    assert other not in usual


def test_every_row_is_in_the_shipped_taxonomy():
    names = [row["name"] for row in read_source_rows("wordnet_additions.csv")]
    assert names == sorted(set(names))
    taxonomy = load_taxonomy()
    assert [name for name in names if name.replace(" ", "").replace("-", "") not in taxonomy] == []
