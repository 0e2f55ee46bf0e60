"""Terms of an ontology: how much each kind of name says, and what the home vocabulary adds.

Which class single names are grounded to is scored in `regression.csv`, groups `class labels` and `other ontologies`.
"""

from tests.grounding.ontologies import load_ontology
from tests.grounding.records import LAB, ground_names, local, make_class, make_tbox
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.ontology import TBox


def score(name: str, ontology: str | TBox) -> float:
    """Return the score of the best candidate of a name."""
    tbox = load_ontology(ontology) if isinstance(ontology, str) else ontology
    return ground_names([name], tbox)[0].candidates[0].score


def test_a_label_scores_more_than_a_synonym_and_a_synonym_more_than_the_last_word_of_a_label():
    assert score("beaker", "laboratory") > score("becherglas", "laboratory") > score("vessel", "laboratory")


def test_the_definition_raises_the_score_of_its_sense():
    # WordNet's posts: an upright (newel) and a military installation (garrison).
    assert score("newel", "posts") > score("newel", "army")
    assert score("garrison", "army") > score("garrison", "posts")


def test_the_iri_can_name_the_sense():
    # WordNet's flutes: the woodwind, the wineglass, the groove.
    glass = make_class("flute.n.wn.artifact..wineglass", label="flute.n.wn.artifact..wineglass")
    lexicon = build_lexicon(make_tbox(glass), load_taxonomy(), {})
    woodwind, wineglass = (lexicon.sense_classes[sense.synset].weight for sense in load_taxonomy().senses("flute")[:2])
    assert wineglass == 1.0 > woodwind


def test_terms_share_no_vendor_names_and_remarks():
    vendors = ("Zigbex", "Lonwrk", "Enoqan")
    names = [f"{vendor}{kind}" for vendor in vendors for kind in ("Gateway", "Module", "Relay")]
    lexicon = build_lexicon(make_tbox(*map(make_class, names)), load_taxonomy(), {})
    assert "gateway" not in lexicon.terms
    # The label is "Bunsen burner (gas)".
    assert "bunsenburnergas" not in build_lexicon(load_ontology("laboratory"), load_taxonomy(), {}).terms


def test_synonyms_from_elsewhere_are_added_by_class_iri():
    synonyms = {LAB + "Beaker": ("griffin cup",), LAB + "NoSuchClass": ("ghost",)}
    terms = build_lexicon(load_ontology("laboratory"), load_taxonomy(), synonyms).terms
    assert terms["griffincup"].class_iri == LAB + "Beaker"
    assert "ghost" not in terms


def test_the_home_ontology_has_no_category_members(home_tbox: TBox):
    assert build_lexicon(home_tbox, load_taxonomy(), home_names()).category_members == {}


def test_a_lent_name_scores_less_than_a_label():
    assert score("hotplate", "hotplates") > score("gas_burner", "hotplates")
    assert local(ground_names(["gas_burner"], load_ontology("hotplates"))[0]) == "HotPlate"
