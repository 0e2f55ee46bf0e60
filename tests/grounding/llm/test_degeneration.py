"""Detection of degenerate completions."""

import json
import math
from time import process_time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.grounding.llm.degeneration import is_degenerate

ROWS = '{"1": {"class": "Cup"}, "2": {"class": "Knife"}}'


FRAGMENTS = st.text(alphabet=st.characters(codec="utf-8"), min_size=8, max_size=300)


@st.composite
def answer_texts(draw: st.DrawFn) -> str:
    """Generate answers for many objects with few classes and equal reasoning, in any JSON layout."""
    names = draw(st.lists(st.sampled_from(["Cup", "Knife", "DesignedContainer"]), min_size=1, max_size=3))
    reasoning = draw(st.sampled_from([None, "It is round.", "It is small, of 0.1 m. So it is a cup, or a bowl."]))
    rows = {}
    for number in range(1, draw(st.integers(1, 150)) + 1):
        row = {"class": names[number % len(names)]}
        rows[str(number)] = row if reasoning is None else {"reasoning": reasoning, **row}
    separators = draw(st.sampled_from([(",", ":"), (", ", ": ")]))
    return json.dumps(rows, indent=draw(st.sampled_from([None, 0, 2, 4])), separators=separators)


class TestDegenerate:
    @given(answer_texts(), st.floats(0, 1))
    def test_accepts_many_rows_with_equal_classes(self, text: str, share: float) -> None:
        assert not is_degenerate(text)
        assert not is_degenerate(text[: 1 + int(share * len(text))])

    @given(st.text(max_size=300), FRAGMENTS, st.integers(0, 30), st.integers(0, 8))
    def test_detects_a_repeated_fragment(self, before: str, fragment: str, more: int, left_out: int) -> None:
        times = max(5, 1 + math.ceil(400 / len(fragment))) + more
        assert is_degenerate(before + (fragment * times)[: -left_out or None])

    @given(st.lists(st.integers(0, 2), min_size=60, max_size=90))
    def test_detects_three_alternating_sentences(self, order: list[int]) -> None:
        fragments = ["The cup is a cup. ", "It may be a bowl. ", "Wait, let me think. "]
        assert is_degenerate("Let us see: " + "".join(fragments[i] for i in order))

    def test_detects_alternating_words(self) -> None:
        assert is_degenerate("The classes: " + "".join("Cup, Bowl, "[i % 7 // 3 * 5 :] for i in range(99)))

    @pytest.mark.parametrize(
        "text",
        [
            "",
            " \n\t",
            '{"1": ' + " " * 500,
            "{" + "\n" * 400,
            "so it is " + "a" * 400,
            "x " + "".join(chr(97 + i * i % 23) for i in range(500)),
            "reply: " + " ".join("qzrtlk" * i for i in range(2, 20)),
            "\n".join("cup " * i for i in range(1, 20)) + "\ncup",
        ],
    )
    def test_detects_empty_endless_and_growing_texts(self, text: str) -> None:
        assert is_degenerate(text)

    @pytest.mark.parametrize(
        "text",
        [
            "{",
            "Cup",
            "It is a cup. " * 4,
            "The box is 0.1 m wide. " * 2 + "It is made of clay, stands on a table and has a handle. " * 3,
            "a bb ccc dddd eeeee ffffff ggggggg",
            "so " * 500 + ROWS,
        ],
    )
    def test_accepts_short_repetitions_and_finished_loops(self, text: str) -> None:
        assert not is_degenerate(text)

    def test_takes_less_than_5_ms(self) -> None:
        text = json.dumps({str(i): {"class": "Cup"} for i in range(5000)})
        start = process_time()
        for _ in range(50):
            is_degenerate(text)
        assert (process_time() - start) / 50 < 0.005
