"""Additions to WordNet: new senses, further hypernyms, and another order of senses."""

import pytest

from tools.build_wordnet import Kinds, Synset, build_columns
from tools.data_files import read_source_rows
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy, load_taxonomy


def taxonomy_of(rows: dict[str, str]) -> Taxonomy:
    """Return a small taxonomy with the additions of the rows."""
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
    """Return the names of each sense and its hypernyms, the first sense first."""
    return [[taxonomy.name(up) for up, _ in taxonomy.walk_up(sense.synset)] for sense in taxonomy.senses(lemma)]


def test_a_new_name_gets_a_sense_below_its_hypernyms():
    taxonomy = taxonomy_of({"torchiere": "lamp|furniture"})
    assert chains(taxonomy, "torchiere") == [["torchiere", "lamp", "furniture", "artifact"]]
    assert taxonomy.senses("torchiere")[0].domain == "artifact"


def test_a_new_sense_comes_before_those_of_wordnet():
    taxonomy = taxonomy_of({"rack": "lamp"})
    assert chains(taxonomy, "rack") == [["rack", "lamp", "artifact"], ["rack", "furniture", "artifact"]]


def test_a_further_hypernym_is_added_once():
    taxonomy = taxonomy_of({"rack": "+lamp|+furniture"})
    assert chains(taxonomy, "rack") == [["rack", "furniture", "lamp", "artifact"]]
    # No synset is a hypernym of itself.
    assert chains(taxonomy_of({"artifact": "+rack"}), "artifact") == [["artifact"]]


def test_a_wrong_hypernym_is_removed():
    assert chains(taxonomy_of({"rack": "-furniture"}), "rack") == [["rack"]]
    with pytest.raises(ValueError, match="'rack,-lamp': WordNet has no such direct hypernym"):
        taxonomy_of({"rack": "-lamp"})
    # WordNet has wheeled vehicles below containers.
    assert "container" not in chains(load_taxonomy(), "forklift")[0]


def test_another_sense_can_come_first():
    assert [sense.domain for sense in taxonomy_of({}).senses("bulb")] == ["plant", "artifact"]
    assert [sense.domain for sense in taxonomy_of({"bulb": "=2"}).senses("bulb")] == ["artifact", "plant"]


def test_a_hypernym_is_meant_in_its_artifact_sense_unless_its_rank_is_given():
    assert chains(taxonomy_of({"edison": "bulb"}), "edison") == [["edison", "lamp", "artifact"]]
    assert chains(taxonomy_of({"tulip": "bulb.1"}), "tulip") == [["tulip", "bulb"]]


def test_a_hypernym_is_meant_in_its_added_sense():
    # The first sense of rack is a lamp here, and so is a wall rack, whichever row comes first.
    expected = ["rack", "lamp", "artifact"]
    assert chains(taxonomy_of({"rack": "lamp", "wall rack": "rack"}), "wallrack") == [["wall rack", *expected]]
    assert chains(taxonomy_of({"wall rack": "rack", "rack": "lamp"}), "wallrack") == [["wall rack", *expected]]
    assert chains(taxonomy_of({"wall rack": "rack.1", "rack": "lamp"}), "wallrack") == [
        ["wall rack", "rack", "furniture", "artifact"]
    ]
    # Workers are people, not ants.
    assert chains(load_taxonomy(), "flightattendant")[0][1] != "insect"


def test_rows_that_refer_to_each_other_mean_the_senses_of_wordnet():
    taxonomy = taxonomy_of({"rack": "stand", "stand": "rack"})
    assert {up for chain in chains(taxonomy, "rack") for up in chain} >= {"rack", "furniture"}


def test_a_row_can_refer_to_a_later_row():
    taxonomy = taxonomy_of({"arc lamp": "floor lamp", "floor lamp": "lamp", "standing lamp": "==floor lamp"})
    assert chains(taxonomy, "arclamp") == [["arc lamp", "floor lamp", "lamp", "artifact"]]
    assert chains(taxonomy, "standinglamp") == [["floor lamp", "lamp", "artifact"]]


def test_a_name_can_be_a_synonym_in_its_first_sense():
    assert chains(taxonomy_of({"rack": "==lamp"}), "rack") == [["lamp", "artifact"], ["rack", "furniture", "artifact"]]


def test_persons_have_their_own_domain():
    assert [sense.domain for sense in taxonomy_of({"jogger": "person"}).senses("jogger")] == ["person"]
    assert chains(load_taxonomy(), "pedestrian")[0][:2] == ["pedestrian", "person"]


def test_the_domain_is_artifact_if_one_hypernym_is_an_artifact():
    assert taxonomy_of({"office kit": "kit"}).senses("officekit")[0].domain == "artifact"
    assert taxonomy_of({"brick": "clay|furniture"}).senses("brick")[0].domain == "artifact"
    assert taxonomy_of({"mud": "clay"}).senses("mud")[0].domain == "substance"
    assert taxonomy_of({"onion": "bulb.1|furniture"}).senses("onion")[0].domain == "plant"
    assert load_taxonomy().senses("holepunch")[0].domain == "artifact"


def test_rejects_unknown_and_circular_hypernyms():
    with pytest.raises(ValueError, match="'rack': 'qwrtz' is not a noun"):
        taxonomy_of({"rack": "qwrtz"})
    with pytest.raises(ValueError, match="refers to itself"):
        taxonomy_of({"arc lamp": "floor lamp", "floor lamp": "arc lamp"})


@pytest.mark.parametrize(
    ("lemma", "kind"), [("rangehood", "kitchen appliance"), ("stovetop", "stove"), ("chandelier", "lamp")]
)
def test_the_shipped_taxonomy_has_the_additions(lemma: str, kind: str):
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
def test_hypernyms_of_the_additions_are_meant_in_the_right_sense(lemma: str, kind: str, other: str):
    usual = chains(load_taxonomy(), lemma.replace(" ", ""))[0]
    assert kind in usual
    assert other not in usual


def test_every_row_is_in_the_shipped_taxonomy():
    names = [row["name"] for row in read_source_rows("wordnet_additions.csv")]
    assert names == sorted(set(names))
    taxonomy = load_taxonomy()
    assert [name for name in names if name.replace(" ", "").replace("-", "") not in taxonomy] == []
