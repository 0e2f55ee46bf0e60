"""Answers: what counts as a class, what is unreadable, and what is no answer but noise."""

import json
import math
from dataclasses import replace
from time import perf_counter

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.grounding.records import LAB, SOMA, make_class, make_tbox
from usd2kg.grounding import ObjectView
from usd2kg.grounding.llm.answers import Answer, parse_answers, repair_request
from usd2kg.grounding.llm.degeneration import is_degenerate
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompts import Batch, build_requests
from usd2kg.grounding.model import Status

TBOX = make_tbox(
    make_class("Cup", base=SOMA),
    make_class("Knife", base=SOMA),
    make_class("OBO_1", label="Coffee Pot"),
    make_class("Vase"),
    make_class("Vase", base="https://other.example/things#"),
    make_class("pan"),
    make_class("PAN"),
)
CUP, KNIFE, POT = SOMA + "Cup", SOMA + "Knife", LAB + "OBO_1"


def batch_of(count: int, **options: object) -> Batch:
    views = [ObjectView(name=f"thing_{i}") for i in range(count)]
    return build_requests(views, TBOX, PromptOptions(objects_per_prompt=count, **options))[0]


def parse(text: str, count: int = 2) -> list[Answer]:
    return parse_answers(text, batch_of(count), TBOX)


def classes(text: str, count: int = 2) -> list[str | None]:
    return [answer.class_iri for answer in parse(text, count)]


def one(value: object) -> Answer:
    (answer,) = parse(json.dumps({"1": {"class": value}}), 1)
    return answer


ROWS = '{"1": {"class": "Cup"}, "2": {"class": "Knife"}}'


class TestForms:
    @pytest.mark.parametrize(
        "text",
        [
            ROWS,
            f"```json\n{ROWS}\n```",
            f"```\n{ROWS}\n```\nI hope this helps {{really}}.",
            f"<think>Object 1 {{a cup?}} is round.</think>\nSo the answer is {ROWS}",
            f'At first {{"1": {{"class": "Knife"}}, "2": {{"class": "Cup"}}}}, but no: {ROWS}',
            f'{ROWS} As for object 1, {{"1": {{"class": "Knife"}}}} would be wrong.',
            '{"2": "Knife", "1": "Cup", "3": "Cup"}',
            '{"1": {"class": "Cup"}, "2": {"class": "Knife"}',
            '{"1": {"class": "Cup"}, "2": "Knife", "3": {"cla',
            '{"1": {"reasoning": "line\nbreak", "class": "Cup"}, "2": {"class": "Knife"}}',
        ],
    )
    def test_json_is_found_wherever_it_stands(self, text: str) -> None:
        assert classes(text) == [CUP, KNIFE]

    def test_one_object_needs_no_number(self) -> None:
        assert classes('{"reasoning": "round", "class": "Cup"}', 1) == [CUP]
        assert classes('{"class": "Cup"}') == [None, None]

    def test_reasoning_is_kept(self) -> None:
        answers = parse('{"1": {"reasoning": "It is round.", "class": "Cup"}, "2": {"reasoning": 7, "class": "Knife"}}')
        assert answers == [Answer(CUP, Status.GROUNDED, "It is round."), Answer(KNIFE, Status.GROUNDED)]

    def test_json_quoted_in_reasoning_is_no_row(self) -> None:
        reasoning = json.dumps('its name says {"1": {"class": "Knife"}, "2": {"class": "Knife"}}')
        assert classes(f'{{"1": {{"reasoning": {reasoning}, "class": "Cup"}}, "2": {{"class": "Cup"}}}}') == [CUP, CUP]
        assert classes(f'{{"1": {{"class": "Cup"}}, "2": {{"reasoning": {reasoning}') == [CUP, None]

    def test_a_row_that_breaks_off_is_unreadable(self) -> None:
        assert parse('{"1": {"class": "Cup"}, "2": {"class": "Kni')[1] == Answer(
            None, Status.UNREADABLE, problem="the answer has no row for it"
        )

    @pytest.mark.parametrize("text", ["A cup and a knife.", "[1, 2]", "{{{{", '{"a": ' * 100_000, "null"])
    def test_a_text_without_rows_is_unreadable(self, text: str) -> None:
        start = perf_counter()
        answers = parse(text)
        assert perf_counter() - start < 5
        assert [(answer.status, answer.problem) for answer in answers] == [
            (Status.UNREADABLE, "the answer has no readable JSON object")
        ] * 2

    def test_an_empty_text_is_unreadable(self) -> None:
        assert [answer.problem for answer in parse(" \n")] == ["the answer was empty"] * 2

    @given(st.text() | st.text(alphabet='{}[]":,12\\ aclsCup'))
    def test_no_text_raises_or_invents(self, text: str) -> None:
        answers = parse(text)
        assert len(answers) == 2
        for answer in answers:
            assert (answer.class_iri in TBOX.by_iri) == (answer.status is Status.GROUNDED)
            assert bool(answer.problem) == (answer.class_iri is None)


class TestClasses:
    @pytest.mark.parametrize(
        ("said", "meant"),
        [
            ("Cup", CUP),
            (" cup ", CUP),
            (CUP, CUP),
            (f"<{CUP}>", CUP),
            ("soma:Cup", CUP),
            ("SOMA:cup", CUP),
            ("OBO_1", POT),
            ("coffee pot", POT),
            ("onto:Vase", LAB + "Vase"),
            ("things:vase", "https://other.example/things#Vase"),
            ("pan", LAB + "pan"),
            ("PAN", LAB + "PAN"),
        ],
    )
    def test_a_class_goes_by_what_people_call_it(self, said: str, meant: str) -> None:
        assert one(said) == Answer(meant, Status.GROUNDED)

    @pytest.mark.parametrize(
        ("said", "problem"),
        [
            ("Teacup", '"Teacup" is no class of the list'),
            ("", '"" is no class of the list'),
            ("Vase", '"Vase" may mean onto:Vase or things:Vase'),
            ("Pan", '"Pan" may mean PAN or pan'),
            (["Cup"], '"[\\"Cup\\"]" is no name of a class'),
            (7, '"7" is no name of a class'),
            ("a\n</objects>", '"a\\n\\u003c/objects\\u003e" is no class of the list'),
        ],
    )
    def test_what_is_no_class_is_unreadable(self, said: object, problem: str) -> None:
        assert one(said) == Answer(None, Status.UNREADABLE, problem=problem)

    def test_a_row_without_class_is_unreadable(self) -> None:
        assert parse('{"1": {"klass": "Cup"}}', 1)[0].problem == "its row has no class"

    def test_a_class_that_was_not_offered_is_unreadable(self) -> None:
        (batch,) = build_requests([ObjectView(name="x")], TBOX, PromptOptions(), [[CUP]])
        (answer,) = parse_answers('{"1": {"class": "Knife"}}', batch, TBOX)
        assert (answer.status, answer.problem) == (Status.UNREADABLE, '"Knife" is a class, but not one of the list')

    @pytest.mark.parametrize("said", [None, "none", "Unknown", " null "])
    def test_refusing_is_no_answer_of_its_own_kind(self, said: str | None) -> None:
        answer = one(said)
        assert (answer.class_iri, answer.status) == (None, Status.REFUSED)
        assert answer.problem.startswith("the model named no class")

    def test_a_null_row_is_a_refusal(self) -> None:
        assert [answer.status for answer in parse('{"1": null, "2": "Cup"}')] == [Status.REFUSED, Status.GROUNDED]

    def test_a_class_called_unknown_is_a_class(self) -> None:
        tbox = make_tbox(make_class("Unknown"))
        (batch,) = build_requests([ObjectView(name="x")], tbox, PromptOptions())
        assert parse_answers('{"1": {"class": "unknown"}}', batch, tbox)[0].class_iri == LAB + "Unknown"


class TestLogprob:
    """By the tokens that spell the class of a row."""

    TOKENS = (
        ('{"1": "', -1.0), ("C", -0.25), ("up", -0.5), ('", "2": {"class": "', -1.0), ("Tea", -0.125),
        ('cup"}, ', -0.25), ('"3": null}', -2.0),
    )  # fmt: skip
    TEXT = '{"1": "Cup", "2": {"class": "Teacup"}, "3": null}'

    def logprobs(self, tokens: tuple[tuple[str, float], ...]) -> list[float | None]:
        return [answer.logprob for answer in parse_answers(self.TEXT, batch_of(4), TBOX, tokens)]

    def test_each_row_has_its_own(self) -> None:
        assert "".join(piece for piece, _ in self.TOKENS) == self.TEXT
        # The third says null; the fourth has no row.
        assert self.logprobs(self.TOKENS) == [-0.75, -0.375, -2.0, None]

    def test_without_tokens_or_with_those_of_another_text_it_is_unknown(self) -> None:
        assert self.logprobs(()) == [None] * 4
        assert self.logprobs(self.TOKENS[:-1]) == [None] * 4

    def test_a_class_that_nobody_knows_has_one_too(self) -> None:
        text = '{"1": {"class": "Chalice"}}'
        [answer] = parse_answers(text, batch_of(1), TBOX, ((text, -0.5),))
        assert (answer.status, answer.logprob) == (Status.UNREADABLE, -0.5)


class TestRepair:
    def test_it_shows_the_same_images(self) -> None:
        batch = batch_of(1)
        shown = replace(batch, request=replace(batch.request, images=(b"front", b"side")))
        assert repair_request(shown, "", parse_answers("", shown, TBOX)).images == (b"front", b"side")

    def test_it_quotes_what_was_wrong_and_offers_the_same(self) -> None:
        batch = batch_of(3, strategy=Strategy.CHAIN_OF_THOUGHT, temperature=0.5)
        text = '{"1": "Cup", "2": "Tea\\n</problems>cup"}'
        repair = repair_request(batch, text, parse_answers(text, batch, TBOX))
        assert repair.user == (
            batch.request.user
            + "\nAn earlier answer to this could not be used. What was wrong with it, quoted as data:\n"
            "<problems>\n"
            'the answer began: "{\\"1\\": \\"Cup\\", \\"2\\": \\"Tea\\\\n\\u003c/problems\\u003ecup\\"}"\n'
            'object 2: "Tea\\n\\u003c/problems\\u003ecup" is no class of the list\n'
            "object 3: the answer has no row for it\n"
            "</problems>\n"
            "Answer again for all of the objects, as one JSON object in the form above, "
            "with classes of the list only.\n"
        )
        assert (repair.system, repair.schema, repair.temperature) == (batch.request.system, batch.request.schema, 0.5)

    def test_long_texts_are_cut(self) -> None:
        batch = batch_of(1)
        text = "so " * 100_000
        assert len(repair_request(batch, text, parse_answers(text, batch, TBOX)).user) < len(batch.request.user) + 1000


FRAGMENTS = st.text(alphabet=st.characters(codec="utf-8"), min_size=8, max_size=300)


@st.composite
def answer_texts(draw: st.DrawFn) -> str:
    """Answers for many objects, of few classes and with the same reasoning, in any layout."""
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
    def test_answers_of_many_identical_classes_are_not(self, text: str, share: float) -> None:
        assert not is_degenerate(text)
        assert not is_degenerate(text[: 1 + int(share * len(text))])

    @given(st.text(max_size=300), FRAGMENTS, st.integers(0, 30), st.integers(0, 8))
    def test_a_fragment_over_and_over_is(self, before: str, fragment: str, more: int, left_out: int) -> None:
        times = max(5, 1 + math.ceil(400 / len(fragment))) + more
        assert is_degenerate(before + (fragment * times)[: -left_out or None])

    @given(st.lists(st.integers(0, 2), min_size=60, max_size=90))
    def test_a_mix_of_three_fragments_is(self, order: list[int]) -> None:
        fragments = ["The cup is a cup. ", "It may be a bowl. ", "Wait, let me think. "]
        assert is_degenerate("Let us see: " + "".join(fragments[i] for i in order))

    def test_a_mix_of_words_is(self) -> None:
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
    def test_noise_is(self, text: str) -> None:
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
    def test_short_texts_and_those_that_went_on_are_not(self, text: str) -> None:
        assert not is_degenerate(text)

    def test_looking_is_quick(self) -> None:
        text = json.dumps({str(i): {"class": "Cup"} for i in range(5000)})
        start = perf_counter()
        for _ in range(50):
            is_degenerate(text)
        assert (perf_counter() - start) / 50 < 0.005
