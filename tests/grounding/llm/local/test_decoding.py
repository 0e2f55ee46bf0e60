"""decode_answer: answers that conform to the schema whatever the model prefers."""

import json
import math
import re
from collections.abc import Callable

import pytest

from tests.grounding.llm.local.fakes import FakeModel, Probabilities
from usd2kg.grounding.llm.completion import Finish
from usd2kg.grounding.llm.local.decoding import DecodedAnswer, DecodingPlan, decode_answer
from usd2kg.grounding.llm.local.json_tokens import classify_tokens
from usd2kg.grounding.llm.local.skeleton import read_schema

NAMES = ["Cup", "Knife"]
PIECES = ("Cup", "Kni", "fe", '"}', "A handle", '. "', "x ", "é")


def schema(count: int, *, has_reasoning: bool = False) -> dict[str, object]:
    properties: dict[str, object] = {"class": {"type": "string", "enum": NAMES}}
    if has_reasoning:
        properties = {"reasoning": {"type": "string"}} | properties
    row = {"type": "object", "properties": properties}
    return {"type": "object", "properties": {str(number): row for number in range(1, count + 1)}}


def write(
    predict: Callable[[str], Probabilities],
    count: int = 1,
    *,
    has_reasoning: bool = False,
    room: int = 10_000,
    temperature: float = 0.0,
    seed: int = 0,
) -> tuple[DecodedAnswer, FakeModel]:
    model = FakeModel(predict, *PIECES)
    plan = DecodingPlan(read_schema(schema(count, has_reasoning=has_reasoning)), model.tokenizer)
    vocabulary = classify_tokens(model.tokenizer.pieces, model.tokenizer.ends)
    written = decode_answer(plan, model, vocabulary, max_tokens=room, temperature=temperature, seed=seed)
    assert "".join(text for text, _ in written.tokens) == written.text
    assert len(written.tokens) <= room
    assert all(logprob <= 0 for _, logprob in written.tokens)
    return written, model


def mostly_cups(text: str) -> Probabilities:
    """Cup with 0.8 and Knife with 0.2 among the offered names; other text is more probable than both."""
    if text.endswith('"class": "'):
        return {"Cup": 0.08, "Kni": 0.02, "x ": 0.9}
    return {"fe": 1.0} if text.endswith("Kni") else {'"}': 1.0}


class TestClasses:
    def test_follow_the_schema(self):
        written, model = write(mostly_cups)
        assert written.text == '{"1": {"class": "Cup"}}'
        assert written.finish is Finish.STOP
        assert model.contexts[0] == '{"1": {"class": "'

    def test_have_their_probability_among_the_offered_names(self):
        written, _ = write(mostly_cups)
        assert {text: logprob for text, logprob in written.tokens if logprob} == {"Cup": pytest.approx(math.log(0.8))}

    def test_depend_on_the_preceding_rows(self):
        def knife_behind_a_cup(text: str) -> Probabilities:
            if text.endswith('"class": "'):
                return {"Cup": 0.1, "Kni": 0.9} if "Cup" in text else {"Cup": 0.9, "Kni": 0.1}
            return mostly_cups(text)

        written, _ = write(knife_behind_a_cup, 3)
        assert json.loads(written.text) == {"1": {"class": "Cup"}, "2": {"class": "Knife"}, "3": {"class": "Knife"}}

    def test_are_sampled_reproducibly_with_a_temperature(self):
        texts = [write(mostly_cups, 20, temperature=1.0, seed=seed)[0].text for seed in (1, 1, 2)]
        assert texts[0] == texts[1] != texts[2]
        assert 0 < texts[0].count("Knife") < 12

    def test_are_the_most_probable_ones_at_low_temperature(self):
        assert "Knife" not in write(mostly_cups, 20, temperature=0.05)[0].text


def reasoning(*pieces: str | bytes) -> Callable[[str], Probabilities]:
    """Return a model that generates these pieces as reasoning, repeating the last one, and then Cup."""
    texts = [piece if isinstance(piece, str) else piece.decode("utf-8", "replace") for piece in pieces]

    def predict(text: str) -> Probabilities:
        reasoning_so_far = text.rpartition('"reasoning": "')[2]
        if '"class": "' in reasoning_so_far:
            return {"Cup": 0.9, '"}': 1.0}
        generated = ["".join(texts[:count]) for count in range(len(texts))]
        return {pieces[generated.index(reasoning_so_far) if reasoning_so_far in generated else -1]: 0.5}

    return predict


class TestFreeTexts:
    def test_end_at_the_quote_and_keep_the_text_before_it(self):
        written, _ = write(reasoning("A handle", '. "'), has_reasoning=True)
        assert json.loads(written.text) == {"1": {"reasoning": "A handle. ", "class": "Cup"}}
        assert written.finish is Finish.STOP
        # Tokens that cannot occur in a string are excluded, so the others share their probability.
        handle = next(logprob for text, logprob in written.tokens if text == "A handle")
        assert handle == pytest.approx(0.0, abs=1e-6)

    def test_end_at_the_end_of_generation_token(self):
        written, _ = write(reasoning("A handle", ""), has_reasoning=True)
        assert json.loads(written.text)["1"] == {"reasoning": "A handle", "class": "Cup"}

    def test_are_truncated_after_256_tokens(self):
        def numbers(text: str) -> Probabilities:
            # 1 2 3 …, without repetition or end.
            reasoning_so_far = text.rpartition('"reasoning": "')[2]
            generated = re.findall(r"\d+ ", reasoning_so_far)
            rest = f"{len(generated) + 1} ".removeprefix(reasoning_so_far.rpartition(" ")[2])
            return {"Cup": 1.0} if '"class": "' in text else {rest[0]: 1.0}

        written, _ = write(numbers, has_reasoning=True)
        empty, _ = write(reasoning('"}'), has_reasoning=True)
        assert written.finish is Finish.LENGTH
        row = json.loads(written.text)["1"]
        # 9 numbers of two characters and 79 of three are 255 characters; one more follows.
        assert row == {"reasoning": " ".join(map(str, range(1, 89))) + " 8", "class": "Cup"}
        assert len(written.tokens) - len(empty.tokens) == 256

    def test_are_cut_off_at_a_loop(self):
        written, _ = write(reasoning("A handle"), has_reasoning=True)
        assert written.finish is Finish.DEGENERATE
        row = json.loads(written.text)["1"]
        # The loop is detected at the first multiple of 16 tokens, of 8 characters each, beyond 400 characters.
        assert row == {"reasoning": "A handle" * 64, "class": "Cup"}

    def test_replace_invalid_utf8(self):
        written, _ = write(reasoning(b"\xc3", '"}'), has_reasoning=True)
        assert json.loads(written.text)["1"]["reasoning"] == "\N{REPLACEMENT CHARACTER}"

    def test_join_the_tokens_of_a_character(self):
        written, _ = write(reasoning(b"\xc3", b"\xa9", '. "'), has_reasoning=True)
        assert json.loads(written.text)["1"]["reasoning"] == "é. "


class TestTokenLimit:
    def test_omits_rows_that_do_not_fit(self):
        whole, _ = write(mostly_cups, 3)
        written, _ = write(mostly_cups, 3, room=len(whole.tokens) - 1)
        assert json.loads(written.text) == {"1": {"class": "Cup"}, "2": {"class": "Cup"}}
        assert written.finish is Finish.LENGTH

    def test_leaves_an_empty_object_if_no_row_fits(self):
        written, model = write(mostly_cups, 3, room=5)
        assert (written.text, written.finish, model.contexts) == ("{}", Finish.LENGTH, [])

    def test_truncates_free_texts_so_that_every_row_fits(self):
        rows = 3
        bare, _ = write(reasoning('. "'), rows, has_reasoning=True)
        written, _ = write(reasoning("A handle"), rows, has_reasoning=True, room=len(bare.tokens) + 10)
        answer = json.loads(written.text)
        assert [row["class"] for row in answer.values()] == ["Cup"] * rows
        assert all(row["reasoning"] for row in answer.values())
        assert written.finish is Finish.LENGTH
