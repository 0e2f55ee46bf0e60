"""The words of a TBox: which terms name which class, and which meaning of a word a class stands for."""

import pytest

from tests.grounding.records import LAB, SOMA, make_class, make_tbox
from usd2kg.grounding.lexical.alignment.lexicon import Lexicon, build_lexicon, home_names, sense_weight
from usd2kg.grounding.lexical.concepts.taxonomy import Sense, load_taxonomy
from usd2kg.ontology import TBox


def lexicon_of(tbox: TBox, synonyms: dict[str, tuple[str, ...]] | None = None) -> Lexicon:
    return build_lexicon(tbox, load_taxonomy(), synonyms or {})


def named(lexicon: Lexicon, term: str) -> str | None:
    found = lexicon.terms.get(term)
    return found.class_iri.rpartition("#")[2] if found else None


def anchored(lexicon: Lexicon, lemma: str) -> dict[int, str]:
    """Return rank of meaning → class, for the meanings of a word that are aligned with a class."""
    senses = load_taxonomy().senses(lemma)
    anchors = {sense.rank: lexicon.anchors.get(sense.synset) for sense in senses}
    return {rank: anchor.class_iri.rpartition("#")[2] for rank, anchor in anchors.items() if anchor}


LABORATORY = make_tbox(
    make_class("Equipment"),
    make_class("GlassVessel", "Equipment", label="glass vessel"),
    make_class("Beaker", "GlassVessel", synonyms=("beaker glass", "Becherglas")),
    make_class("BunsenBurner", "Equipment", label="Bunsen burner (gas)", synonyms=("burners",)),
)


def test_label_local_name_and_synonyms_name_the_class():
    lexicon = lexicon_of(LABORATORY)
    terms = ["equipment", "glassvessel", "beaker", "beakerglass", "becherglas", "bunsenburner"]
    assert [named(lexicon, term) for term in terms] == [
        "Equipment",
        "GlassVessel",
        "Beaker",
        "Beaker",
        "Beaker",
        "BunsenBurner",
    ]
    assert named(lexicon, "centrifuge") is None


def test_a_remark_in_brackets_is_no_part_of_the_label():
    assert named(lexicon_of(LABORATORY), "bunsenburnergas") is None


def test_terms_are_kept_in_the_singular():
    lexicon = lexicon_of(LABORATORY)
    assert named(lexicon, "burner") == "BunsenBurner"
    assert named(lexicon, "burners") is None


def test_a_label_weighs_more_than_a_synonym_and_a_synonym_more_than_a_head():
    lexicon = lexicon_of(LABORATORY)
    label, synonym, head = (lexicon.terms[term].weight for term in ("beaker", "becherglas", "vessel"))
    assert label == 1.0
    assert label > synonym > head


def test_the_last_word_of_a_label_stands_for_the_class_where_no_class_has_that_name():
    assert named(lexicon_of(LABORATORY), "vessel") == "GlassVessel"
    with_vessel = make_tbox(*LABORATORY.classes, make_class("Vessel", "Equipment"))
    assert named(lexicon_of(with_vessel), "vessel") == "Vessel"


def test_the_last_word_of_a_mere_synonym_stands_for_nothing():
    # "beaker glass" is a synonym: not everything called glass is a beaker.
    assert named(lexicon_of(LABORATORY), "glass") is None


def test_synonyms_from_elsewhere_are_added_by_class():
    lexicon = lexicon_of(LABORATORY, {LAB + "Beaker": ("griffin cup",), LAB + "NoSuchClass": ("ghost",)})
    assert named(lexicon, "griffincup") == "Beaker"
    assert named(lexicon, "ghost") is None


def test_an_own_label_wins_over_the_synonym_of_another_class():
    tbox = make_tbox(make_class("Cup", synonyms=("mug",)), make_class("Mug"))
    assert named(lexicon_of(tbox), "mug") == "Mug"
    tbox = make_tbox(make_class("Cup"), make_class("Amug", synonyms=("cup",)))
    assert named(lexicon_of(tbox), "cup") == "Cup"


def test_classes_of_other_ontologies_borrow_the_names_of_a_home_class_with_their_label(home_tbox: TBox):
    other = make_tbox(make_class("Thing"), make_class("HotPlate", "Thing", label="hotplate"), make_class("Furniture"))
    lexicon = lexicon_of(other, dict(home_names()))
    assert named(lexicon, "gasburner") == "HotPlate"
    assert lexicon.terms["hotplate"].weight > lexicon.terms["gasburner"].weight
    # What counts as furniture differs from ontology to ontology.
    assert named(lexicon, "carpet") is None
    # In the home TBox itself nothing is borrowed.
    assert lexicon_of(home_tbox, dict(home_names())).terms["gasburner"].class_iri.endswith("#Hotplate")


def test_a_borrowed_name_is_no_meaning_of_its_own():
    other = make_tbox(make_class("Floor"), make_class("Covering"))
    assert anchored(lexicon_of(other, dict(home_names())), "floorcovering") == {}


def test_of_two_equal_claims_the_general_class_keeps_the_word():
    tbox = make_tbox(
        make_class("Equipment"),
        make_class("Zvessel", "Equipment", synonyms=("container",)),
        make_class("Ajar", "Zvessel", synonyms=("container",)),
    )
    assert named(lexicon_of(tbox), "container") == "Zvessel"


def test_jargon_that_many_names_begin_with_is_dropped(home_tbox: TBox):
    # SOMA calls things DesignedTool, DesignedContainer… and nobody says "designed tool".
    lexicon = lexicon_of(make_tbox(*(make_class(name) for name in ("DesignedTool", "DesignedBox", "DesignedRack"))))
    assert named(lexicon, "designedtool") == named(lexicon, "tool") == "DesignedTool"
    # As good as its label, and not only the last word of it.
    assert lexicon.terms["tool"].weight == 1.0
    assert named(lexicon_of(home_tbox), "container") == "DesignedContainer"


@pytest.mark.parametrize(
    ("names", "term"),
    [
        # Twice is no habit of the ontology's.
        (["DesignedTool", "DesignedBox"], "tool"),
        # "Kitchen" is a thing's name: a kitchen knife is not just any knife.
        (["KitchenTool", "KitchenBox", "KitchenRack"], "box"),
        # Cooking utensils are known by that name.
        (["CookingUtensil", "CookingDish", "CookingRack"], "rack"),
    ],
)
def test_other_first_words_are_kept(names: list[str], term: str):
    lexicon = lexicon_of(make_tbox(*(make_class(name) for name in names)))
    # The bare word is at most a head, never the label itself.
    assert lexicon.terms[term].weight < 1.0


def test_a_label_is_aligned_with_the_meaning_below_its_superclass():
    # WordNet's cranes: a constellation (3), the machine that lifts (4), the wading bird (5).
    machine = make_tbox(make_class("LiftingDevice"), make_class("Crane", "LiftingDevice"))
    assert anchored(lexicon_of(machine), "crane") == {4: "Crane"}
    bird = make_tbox(make_class("Bird"), make_class("WadingBird", "Bird"), make_class("Crane", "WadingBird"))
    assert 5 in anchored(lexicon_of(bird), "crane")
    assert 4 not in anchored(lexicon_of(bird), "crane")


def test_a_label_is_aligned_with_the_meaning_that_its_text_speaks_of():
    # WordNet's posts: among others an upright (1) and a military installation (3).
    upright, camp = load_taxonomy().senses("post")[:2]
    carrier = lexicon_of(make_tbox(make_class("Post", comment="An upright that carries a beam."))).anchors
    assert carrier[upright.synset].weight == 1.0
    base = lexicon_of(make_tbox(make_class("Post", comment="A military installation."))).anchors
    assert base[camp.synset].weight == 1.0 > base[upright.synset].weight


def test_an_iri_may_tell_the_meaning():
    # WordNet's flutes: the woodwind (1), the wineglass (2), the groove (3).
    glass = make_class("flute.n.wn.artifact..wineglass", label="flute.n.wn.artifact..wineglass")
    lexicon = lexicon_of(make_tbox(glass))
    weights = {sense.rank: lexicon.anchors[sense.synset].weight for sense in load_taxonomy().senses("flute")[:2]}
    assert weights[2] == 1.0 > weights[1]


def test_other_meanings_of_a_kind_are_meant_less():
    # A lamp is a source of illumination (1) and a piece of furniture (2).
    tbox = make_tbox(make_class("Furniture"), make_class("Lamp", "Furniture"))
    lexicon = lexicon_of(tbox)
    light, furniture = (lexicon.anchors[sense.synset] for sense in load_taxonomy().senses("lamp"))
    assert {light.class_iri, furniture.class_iri} == {LAB + "Lamp"}
    assert furniture.weight == 1.0 > light.weight


def test_all_that_is_made_is_of_the_default_class_where_no_class_is_above_it():
    made = load_taxonomy().senses("artifact")[0].synset
    assert lexicon_of(LABORATORY).anchors[made].class_iri == LAB + "Equipment"
    artifacts = make_tbox(make_class("Artifact"), make_class("Agent"), make_class("Cook", "Agent"))
    assert lexicon_of(artifacts).anchors[made].class_iri == LAB + "Artifact"
    # Here no class is any kind of thing.
    assert lexicon_of(make_tbox(make_class("Qualia"))).anchors == {}


def test_a_thing_takes_the_class_of_what_it_is_a_kind_of_at_home(home_tbox: TBox):
    other = make_tbox(make_class("Thing"), make_class("Appliances", "Thing"), make_class("Furniture", "Thing"))
    lexicon = lexicon_of(other, dict(home_names()))
    assert named(lexicon, "carcharger") is None
    assert {lexicon.borrowed[name].class_iri for name in ("carcharger", "gasoven")} == {LAB + "Appliances"}
    assert lexicon.borrowed["toolcabinet"].class_iri == LAB + "Furniture"
    # SOMA has ovens below the containers too, and buildings there alone.
    vessels = lexicon_of(make_tbox(make_class("Thing"), make_class("Container", "Thing")), dict(home_names()))
    assert "gasoven" not in vessels.borrowed
    assert "warehouse" not in vessels.borrowed
    # What is but an artifact at home may be anything here.
    assert "poster" not in lexicon.borrowed
    assert lexicon_of(home_tbox, dict(home_names())).borrowed == {}


def test_what_several_classes_are_called_after_their_vendor_is_none_of_them():
    vendors = ("Zigbex", "Lonwrk", "Enoqan")
    names = [f"{vendor}{kind}" for vendor in vendors for kind in ("Gateway", "Module", "Relay")]
    lexicon = lexicon_of(make_tbox(*map(make_class, names), make_class("ZigbexLock")))
    assert named(lexicon, "gateway") is None
    assert named(lexicon, "lock") == "ZigbexLock"


@pytest.mark.parametrize("label", ["shading device", "Zqshading device"])
def test_one_device_is_not_what_any_device_is(label: str):
    others = [make_class(f"Zqshading{kind}", "Asset") for kind in ("Louvre", "Awning", "Blind")]
    lexicon = lexicon_of(make_tbox(make_class("Asset"), make_class("Shading", "Asset", label=label), *others))
    assert named(lexicon, "device") is None


def test_a_label_of_something_else_than_its_word_means_first_weighs_less():
    foods = make_class("Food"), make_class("Screwdriver", "Food"), make_class("Orange", "Food")
    lexicon = lexicon_of(make_tbox(*foods))
    # To WordNet a screwdriver is a tool before it is a drink, and an orange is food first.
    assert lexicon.terms["screwdriver"].weight < lexicon.terms["orange"].weight == 1.0


def test_a_name_in_odd_capitals_is_no_common_noun():
    sequencer = make_tbox(make_class("OBI_0000696", label="SOLiD 4 System", synonyms=("SOLiD",)), make_class("Device"))
    assert "OBI_0000696" not in anchored(lexicon_of(sequencer), "solid").values()


def test_a_label_with_a_short_word_is_aligned_where_it_is_a_noun_of_several():
    hospital = make_tbox(make_class("CTScanner", label="CT scanner"), make_class("Device"))
    assert "CTScanner" in anchored(lexicon_of(hospital), "ctscanner").values()


def test_a_general_synonym_makes_no_class_that_of_all_things():
    tbox = make_tbox(make_class("Object"), make_class("Exhibit", "Object", synonyms=("artefact",)))
    assert "Exhibit" not in anchored(lexicon_of(tbox), "artefact").values()


def test_things_made_come_before_other_meanings():
    made, animal = Sense(0, 1, "artifact"), Sense(1, 1, "animal")
    assert sense_weight(made) > sense_weight(animal)
    assert sense_weight(made) > sense_weight(Sense(2, 2, "artifact"))


def test_the_default_is_the_root_with_the_most_classes_below_it(home_tbox: TBox):
    assert lexicon_of(LABORATORY).default == LAB + "Equipment"
    two = make_tbox(make_class("Alone"), make_class("Wide"), make_class("A", "Wide"), make_class("B", "Wide"))
    assert lexicon_of(two).default == LAB + "Wide"
    assert lexicon_of(home_tbox).default.endswith("#DesignedArtifact")
    # Commands are many, and no thing is one.
    commands = [make_class(f"{verb}Command", "Command") for verb in ("Open", "Close", "Stop")]
    domotic = make_tbox(make_class("Command"), make_class("Managed"), make_class("Fridge", "Managed"), *commands)
    assert lexicon_of(domotic).default == LAB + "Managed"
    # What is not known to be managed is unmanaged.
    both = make_tbox(*domotic.classes, make_class("UnManaged"), make_class("Wall", "UnManaged"))
    assert lexicon_of(both).default == LAB + "UnManaged"


def test_the_vocabulary_holds_the_words_of_all_terms():
    assert {"bunsen", "burner", "glass", "vessel", "beaker"} <= lexicon_of(LABORATORY).vocabulary.keys()


def test_the_home_tbox_names_every_class_by_its_own_local_name(home_tbox: TBox):
    lexicon = lexicon_of(home_tbox)
    wrong = [
        cls.local_name
        for cls in home_tbox.classes
        if (term := lexicon.terms.get(cls.local_name.lower())) is None or term.class_iri != cls.iri
    ]
    assert wrong == []
    assert named(lexicon, "cup") == "Cup"
    assert lexicon.terms["cup"].class_iri == SOMA + "Cup"


TOWN = make_tbox(
    make_class("Vehicle"),
    make_class("Cycle", "Vehicle"),
    make_class("Bicycle", "Cycle"),
    make_class("JanitorialUnit", "Vehicle", label="janitorial unit"),
    make_class("Scooter", "Vehicle"),
)


def test_of_two_classes_for_one_meaning_that_of_its_first_name_is_meant():
    # WordNet has the cycle and the bicycle as two words for one thing; the bicycle comes first.
    assert anchored(lexicon_of(TOWN), "bicycle")[1] == "Bicycle"


def test_any_equipment_is_called_by_another_word_where_the_label_is_no_noun():
    assert "janitorialunit" not in load_taxonomy()
    assert anchored(lexicon_of(TOWN), "janitorialequipment") == {1: "JanitorialUnit"}


def test_labels_that_measure_or_join_say_what_they_measure_and_join():
    lexicon = lexicon_of(
        make_tbox(
            make_class("Artifact"),
            make_class("BreadPortion", "Artifact", label="portion of bread"),
            make_class("Press", "Artifact", label="newspaper or magazine"),
            make_class("Cleaning", "Artifact", label="cleaning and waste equipment"),
        )
    )
    assert "BreadPortion" in anchored(lexicon, "bread").values()
    assert "Press" in anchored(lexicon, "newspaper").values()
    assert "Press" in anchored(lexicon, "magazine").values()
    assert "Cleaning" in anchored(lexicon, "cleaningequipment").values()


def test_an_ontology_with_trees_speaks_of_what_nobody_made():
    classes = [make_class("Artifact"), make_class("Tree")]
    assert lexicon_of(make_tbox(*classes)).kingdoms == {"plant"}
    assert lexicon_of(make_tbox(classes[0], make_class("Table", "Artifact"))).kingdoms == frozenset()
