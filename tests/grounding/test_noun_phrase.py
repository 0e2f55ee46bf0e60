"""Names read as noun phrases. Which words single names consist of is scored in `readings.csv`."""

import os
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.records import ground_names, ground_view, read_name, read_words
from usd2kg.grounding import ObjectView
from usd2kg.ontology import TBox


class TestParents:
    def test_words_of_the_parent_become_context(self):
        phrase = read_name("cabinet10_drawer_top", ("kitchen", "cabinet10"))
        assert phrase.words == ("drawer", "top")
        assert phrase.context == ("cabinet",)

    def test_without_parents_all_words_stay(self):
        assert read_name("cabinet10_drawer_top").words == ("cabinet", "drawer", "top")
        assert read_name("cabinet10_drawer_top").context == ()

    def test_another_number_is_another_object(self):
        assert read_name("cabinet11_drawer", ("cabinet10",)).context == ()


class TestCorrections:
    def test_records_what_was_written_and_what_was_read(self):
        assert read_name("Cuboard_01").corrections == (("cuboard", "cupboard"),)
        assert read_name("cupboard_01").corrections == ()

    def test_explanation_gives_the_corrected_word(self, home_tbox: TBox):
        (prediction,) = ground_names(["Cuboard"], home_tbox)
        assert "“cuboard” read as “cupboard”" in prediction.explanation

    def test_explanation_gives_the_translation(self, home_tbox: TBox):
        (prediction,) = ground_names(["Kuechenschrank"], home_tbox)
        assert "“kuechenschrank” read as “kitchen cupboard”" in prediction.explanation

    def test_a_correction_lowers_the_score(self, home_tbox: TBox):
        right, corrected = ground_names(["Cupboard", "Cuboard"], home_tbox)
        assert corrected.candidates[0].score < right.candidates[0].score

    @pytest.mark.parametrize("name", ["WallPaper", "Pan_2", "Wand", "table_mat"])
    def test_english_names_are_not_translated(self, name: str):
        assert read_name(name).corrections == ()


@settings(deadline=None, max_examples=150)
@given(st.text(max_size=24), st.lists(st.text(max_size=8), max_size=2))
def test_any_name_is_read_the_same_twice(name: str, parents: list[str]):
    words = read_words(name, tuple(parents))
    assert words == read_words(name, tuple(parents))
    assert all(word and word == word.strip() for word in words)


@settings(deadline=None, max_examples=60)
@given(
    st.lists(st.sampled_from(["cup", "wine", "glass", "lamp", "oven", "door", "red"]), min_size=1, max_size=4),
    st.integers(0, 999),
)
def test_all_identifier_styles_read_alike(words: list[str], number: int):
    camel = "".join(word.title() for word in words)
    snake, kebab = "_".join(words), "-".join(words)
    written = [snake, kebab, camel, camel[0].lower() + camel[1:], f"{camel}_{number}", f"SM_{camel}"]
    assert {read_words(text) for text in written} == {tuple(words)}


def test_explanation_of_a_long_name_stays_short(home_tbox: TBox):
    prediction = ground_view(ObjectView(name="chair " + "elephant " * 4000), home_tbox)
    assert len(prediction.explanation) < 500


def test_words_of_other_objects_have_the_same_order_under_any_hash_seed():
    code = (
        "from usd2kg.grounding.lexical.reading.shortening import forms_of\n"
        "from tests.grounding.records import make_object, make_scene, words_written\n"
        "from usd2kg.grounding import view_objects\n"
        "scene = make_scene(*(make_object(f'/R/{n}') for n in ('pot_big_red_tin', 'tap_tub_pit', 'x')))\n"
        "*_, (_, view) = view_objects(scene)\n"
        "print(words_written(view.neighbourhood, 't', forms_of), words_written(view.neighbourhood, 'p', forms_of))"
    )
    outputs = {
        subprocess.run(
            [sys.executable, "-c", code], env={**os.environ, "PYTHONHASHSEED": seed}, capture_output=True, check=True
        ).stdout
        for seed in ("1", "2")
    }
    assert len(outputs) == 1
