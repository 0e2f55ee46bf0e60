"""What people count among general kinds, though the taxonomy has it elsewhere."""

import re

import pytest

from tests.grounding.records import ground_names, local, make_class, make_tbox
from tests.grounding.test_taxonomy import TINY
from tools import build_categories
from usd2kg.grounding.lexical.alignment.class_labels import wordings
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon, home_names
from usd2kg.grounding.lexical.concepts.categories import members_of, synset_of
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.knowledge import read_rows
from usd2kg.ontology import TBox

OFFICE = make_tbox(
    make_class("Asset"),
    make_class("Stationery", "Asset"),
    make_class("Seating", "Asset"),
    make_class("LightFitting", "Asset", label="light fitting"),
    make_class("Furniture", "Asset"),
    make_class("StorageFurniture", "Furniture", label="storage furniture"),
    make_class("BuiltStructure", "Asset", label="built structure"),
)


def answers(names: list[str], tbox: TBox) -> dict[str, str]:
    return dict(zip(names, map(local, ground_names(names, tbox)), strict=True))


class TestMembers:
    def test_a_name_means_its_first_meaning_or_the_one_that_is_told(self):
        assert synset_of("bun", TINY) == 6
        assert synset_of("bun#2", TINY) == 5
        assert synset_of("flower pot", TINY) == synset_of("flower-pot", TINY) == 6
        assert synset_of("bun#3", TINY) is None
        assert synset_of("ghost", TINY) is None

    def test_a_stapler_is_stationery(self):
        taxonomy = load_taxonomy()
        members = dict(members_of("stationery", taxonomy))
        above_stapler = {up for up, _ in taxonomy.walk_up(taxonomy.senses("stapler")[0].synset)}
        assert above_stapler & members.keys()
        # All members tell of how many things the kind is.
        assert len(set(members.values())) == 1

    def test_a_kind_that_is_not_listed_has_no_members(self):
        assert list(members_of("flurbl", load_taxonomy())) == []


class TestFile:
    """`tools/build_categories.py`, over the tiny taxonomy of `test_taxonomy`."""

    def test_members_below_the_kind_or_below_another_member_say_nothing(self):
        # A knife is a cutter, so a tool; a bun is food.
        assert build_categories.find_informative_members(["tool"], ["cutter", "bun#2"], TINY) == ["bun#2"]
        assert build_categories.find_informative_members(["kit"], ["knife", "tool", "roll"], TINY) == ["tool", "roll"]
        assert build_categories.find_informative_members(["kit"], ["roll", "bun#2"], TINY) == ["roll"]

    def test_a_member_that_the_taxonomy_lacks_is_an_error(self):
        with pytest.raises(ValueError, match=r"kit\|set: 'ghost' is not a noun of the taxonomy"):
            build_categories.find_informative_members(["kit", "set"], ["tool", "ghost"], TINY)

    def test_rows_of_one_kind_are_united_under_all_of_its_names(self):
        # A flower-pot is a knife in the tiny taxonomy, and so is a bun, first of all; but that has another meaning.
        rows = [(["flower-pot", "pot"], ["roll", "food"]), (["cutter"], ["bun"]), (["knife"], ["food", "tool"])]
        assert build_categories.merge_synonymous_kinds(rows, TINY) == [
            (["flower-pot", "pot", "xray", "knife"], ["roll", "food", "tool"]),
            (["cutter"], ["bun"]),
        ]

    def test_things_are_counted_once(self):
        below = [[1, 3], [2, 6], [4], [5], [6], [], []]
        assert build_categories.count_hyponyms([1], below) == 4
        assert build_categories.count_hyponyms([2, 4, 5], below) == 4

    def test_no_kind_has_two_rows(self):
        kinds = [kind.replace("-", " ") for row in read_rows("categories.csv") for kind in row["kinds"].split("|")]
        joined = [kind.replace(" ", "") for kind in kinds]
        assert [kind for kind in kinds if not re.fullmatch(r"[a-z0-9][a-z0-9 '/&.()]*", kind)] == []
        assert len(joined) == len(set(joined))
        assert len(joined) > 2000


class TestGrounding:
    def test_things_are_of_the_class_that_people_count_them_among(self):
        expected = {
            "Stapler_02": "Stationery",
            "sofa_grey": "Seating",
            "DeskLamp": "LightFitting",
            "wardrobe": "StorageFurniture",
            # Nothing is known of built structures but that they are structures.
            "Footbridge": "BuiltStructure",
        }
        assert answers([*expected], OFFICE) == expected

    def test_another_word_for_the_kind_has_the_same_things(self):
        luminaires = make_tbox(make_class("Asset"), make_class("Luminaire", "Asset"))
        assert answers(["BankersLamp"], luminaires) == {"BankersLamp": "Luminaire"}

    def test_a_small_kind_stands_against_a_large_one_of_the_taxonomy(self):
        # To WordNet a sofa is a seat, which is furniture; where there is seating of its own, it is that.
        no_seating = make_tbox(*(cls for cls in OFFICE.classes if cls.local_name != "Seating"))
        assert answers(["sofa"], no_seating) == {"sofa": "Furniture"}
        assert answers(["sofa"], OFFICE) == {"sofa": "Seating"}

    def test_a_kind_of_about_the_size_does_not(self):
        kitchen = make_class("KitchenEquipment", "Asset", label="kitchen equipment")
        only = make_tbox(make_class("Asset"), kitchen)
        assert answers(["refrigerator"], only) == {"refrigerator": "KitchenEquipment"}
        both = make_tbox(*only.classes, make_class("Appliance", "Asset"))
        assert answers(["refrigerator"], both) == {"refrigerator": "Appliance"}

    def test_any_equipment_may_be_called_by_another_word(self):
        assert wordings("printing machine", load_taxonomy())[0] == "printingmachine"
        assert "printingdevice" in wordings("printing machine", load_taxonomy())
        assert wordings("chair", load_taxonomy()) == ["chair"]
        assert wordings("machine", load_taxonomy()) == ["machine"]
        assert wordings("lamps and luminaires", load_taxonomy()) == ["lampsandluminaires", "lamp", "luminaire"]
        printers = make_tbox(make_class("Asset"), make_class("PrintingMachine", "Asset", label="printing machine"))
        assert answers(["photocopier"], printers) == {"photocopier": "PrintingMachine"}

    def test_the_explanation_says_how(self):
        (prediction,) = ground_names(["stapler"], OFFICE)
        assert prediction.explanation == "“stapler” is a kind of “stationery item”, which counts as Stationery"
        equipment = make_tbox(make_class("Asset"), make_class("OfficeEquipment", "Asset", label="office equipment"))
        (prediction,) = ground_names(["telephone"], equipment)
        assert prediction.explanation == "“telephone” counts as OfficeEquipment"

    def test_in_the_home_ontology_its_own_vocabulary_decides(self, home_tbox: TBox):
        assert build_lexicon(home_tbox, load_taxonomy(), home_names()).counted == {}
        assert build_lexicon(OFFICE, load_taxonomy(), home_names()).counted


class TestNamesOfOtherClasses:
    def test_a_longer_noun_is_of_the_class_of_its_last_word_where_that_says_more(self):
        tbox = make_tbox(make_class("Thing"), make_class("Tableware", "Thing"), make_class("Plate", "Tableware"))
        assert answers(["side_plate", "soup_spoon"], tbox) == {"side_plate": "Plate", "soup_spoon": "Tableware"}

    def test_what_the_home_vocabulary_has_no_class_for_goes_to_one_that_another_ontology_has(self):
        cold = make_tbox(make_class("Thing"), make_class("Refrigerator", "Thing"))
        assert answers(["chest_freezer"], cold) == {"chest_freezer": "Refrigerator"}
        frozen = make_tbox(*cold.classes, make_class("Freezer", "Thing"))
        assert answers(["chest_freezer", "minibar_fridge"], frozen) == {
            "chest_freezer": "Freezer",
            "minibar_fridge": "Refrigerator",
        }


class TestLastWordsOfLabels:
    """Where one label alone ends with a word, what is called so may be of that class."""

    TBOX = make_tbox(
        make_class("Equipment"),
        make_class("Vehicle", "Equipment"),
        make_class("KickScooter", "Vehicle"),
        make_class("Device", "Equipment"),
        make_class("AnaesthesiaMachine", "Device"),
    )

    def test_a_word_for_few_things_means_the_class(self):
        assert answers(["old_scooter"], self.TBOX) == {"old_scooter": "KickScooter"}

    def test_a_word_for_many_does_not(self):
        assert answers(["vending_machine", "truck"], self.TBOX) == {"vending_machine": "Device", "truck": "Vehicle"}

    def test_nor_does_one_that_two_labels_end_with(self):
        both = make_tbox(*self.TBOX.classes, make_class("MobilityScooter", "Vehicle"))
        assert answers(["old_scooter"], both) == {"old_scooter": "Vehicle"}
