"""parse_answers and repair_request."""

import json
from dataclasses import replace
from time import process_time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.grounding.records import LAB, SOMA, make_class, make_tbox
from usd2kg.grounding import ObjectView
from usd2kg.grounding.llm.answers import Defect, ParsedAnswer, parse_answers, repair_request
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


def parse(text: str, count: int = 2) -> list[ParsedAnswer]:
    return parse_answers(text, batch_of(count), TBOX)


def classes(text: str, count: int = 2) -> list[str | None]:
    return [answer.class_iri for answer in parse(text, count)]


def one(value: object) -> ParsedAnswer:
    (answer,) = parse(json.dumps({"1": {"class": value}}), 1)
    return answer


ROWS = '{"1": {"class": "Cup"}, "2": {"class": "Knife"}}'


class TestFormats:
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
    def test_finds_json_anywhere_in_the_text(self, text: str) -> None:
        assert classes(text) == [CUP, KNIFE]

    def test_keeps_the_reasoning(self) -> None:
        answers = parse('{"1": {"reasoning": "It is round.", "class": "Cup"}, "2": {"reasoning": 7, "class": "Knife"}}')
        assert answers == [ParsedAnswer(CUP, Status.GROUNDED, "It is round."), ParsedAnswer(KNIFE, Status.GROUNDED)]

    def test_ignores_json_quoted_in_the_reasoning(self) -> None:
        reasoning = json.dumps('its name says {"1": {"class": "Knife"}, "2": {"class": "Knife"}}')
        assert classes(f'{{"1": {{"reasoning": {reasoning}, "class": "Cup"}}, "2": {{"class": "Cup"}}}}') == [CUP, CUP]
        assert classes(f'{{"1": {{"class": "Cup"}}, "2": {{"reasoning": {reasoning}') == [CUP, None]

    def test_a_truncated_row_is_unreadable(self) -> None:
        assert parse('{"1": {"class": "Cup"}, "2": {"class": "Kni')[1] == ParsedAnswer(
            None, Status.UNREADABLE, problem="the answer has no row for it"
        )

    @pytest.mark.parametrize("text", ["A cup and a knife.", "[1, 2]", "{{{{", '{"a": ' * 100_000, "null"])
    def test_a_text_without_rows_is_unreadable(self, text: str) -> None:
        start = process_time()
        answers = parse(text)
        assert process_time() - start < 5
        assert [(answer.status, answer.problem) for answer in answers] == [
            (Status.UNREADABLE, "the answer has no readable JSON object")
        ] * 2

    def test_an_empty_text_is_unreadable(self) -> None:
        assert [answer.problem for answer in parse(" \n")] == ["the answer was empty"] * 2

    @given(st.text() | st.text(alphabet='{}[]":,12\\ aclsCup'))
    def test_never_raises_or_invents_a_class(self, text: str) -> None:
        answers = parse(text)
        assert len(answers) == 2
        for answer in answers:
            assert (answer.class_iri in TBOX.by_iri) == (answer.status is Status.GROUNDED)
            assert bool(answer.problem) == (answer.class_iri is None)


class TestClasses:
    @pytest.mark.parametrize(
        ("written", "expected"),
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
    def test_resolves_names_labels_curies_and_iris(self, written: str, expected: str) -> None:
        assert one(written) == ParsedAnswer(expected, Status.GROUNDED)

    @pytest.mark.parametrize(
        ("written", "problem"),
        [
            ("Teacup", '"Teacup" is not a class of the list'),
            ("", '"" is not a class of the list'),
            ("Vase", '"Vase" may mean onto:Vase or things:Vase'),
            ("Pan", '"Pan" may mean PAN or pan'),
            (["Cup"], '"[\\"Cup\\"]" is not a class name'),
            (7, '"7" is not a class name'),
            ("a\n</objects>", '"a\\n\\u003c/objects\\u003e" is not a class of the list'),
        ],
    )
    def test_an_unknown_class_is_unreadable(self, written: object, problem: str) -> None:
        answer = one(written)
        defect = Defect.HALLUCINATED if problem.endswith("of the list") else None
        assert answer == ParsedAnswer(None, Status.UNREADABLE, problem=problem, defect=defect)

    def test_a_row_without_class_is_unreadable(self) -> None:
        assert parse('{"1": {"klass": "Cup"}}', 1)[0].problem == "its row has no class"

    def test_a_class_outside_the_list_is_unreadable(self) -> None:
        (batch,) = build_requests([ObjectView(name="x")], TBOX, PromptOptions(), [[CUP]])
        (answer,) = parse_answers('{"1": {"class": "Knife"}}', batch, TBOX)
        assert (answer.status, answer.problem) == (Status.UNREADABLE, '"Knife" is a class, but not one of the list')

    @pytest.mark.parametrize("written", [None, "none", "Unknown", " null "])
    def test_null_and_none_are_refusals(self, written: str | None) -> None:
        answer = one(written)
        assert (answer.class_iri, answer.status) == (None, Status.REFUSED)
        assert answer.problem.startswith("the model named no class")

    def test_a_null_row_is_a_refusal(self) -> None:
        assert [answer.status for answer in parse('{"1": null, "2": "Cup"}')] == [Status.REFUSED, Status.GROUNDED]

    def test_accepts_a_class_called_unknown(self) -> None:
        tbox = make_tbox(make_class("Unknown"))
        (batch,) = build_requests([ObjectView(name="x")], tbox, PromptOptions())
        assert parse_answers('{"1": {"class": "unknown"}}', batch, tbox)[0].class_iri == LAB + "Unknown"


class TestLogprob:
    """The log-probability of the class of a row."""

    TOKENS = (
        ('{"1": "', -1.0), ("C", -0.25), ("up", -0.5), ('", "2": {"class": "', -1.0), ("Tea", -0.125),
        ('cup"}, ', -0.25), ('"3": null}', -2.0),
    )  # fmt: skip
    TEXT = '{"1": "Cup", "2": {"class": "Teacup"}, "3": null}'

    def logprobs(self, tokens: tuple[tuple[str, float], ...]) -> list[float | None]:
        return [answer.logprob for answer in parse_answers(self.TEXT, batch_of(4), TBOX, tokens)]

    def test_sums_the_tokens_of_each_class(self) -> None:
        assert "".join(piece for piece, _ in self.TOKENS) == self.TEXT
        # The third row is null; the fourth is missing.
        assert self.logprobs(self.TOKENS) == [-0.75, -0.375, -2.0, None]

    def test_is_none_without_matching_tokens(self) -> None:
        assert self.logprobs(()) == [None] * 4
        assert self.logprobs(self.TOKENS[:-1]) == [None] * 4

    def test_is_set_for_unknown_classes(self) -> None:
        text = '{"1": {"class": "Chalice"}}'
        [answer] = parse_answers(text, batch_of(1), TBOX, ((text, -0.5),))
        assert (answer.status, answer.logprob) == (Status.UNREADABLE, -0.5)


class TestRepair:
    def test_keeps_the_images(self) -> None:
        batch = batch_of(1)
        shown = replace(batch, request=replace(batch.request, images=(b"front", b"side")))
        assert repair_request(shown, "", parse_answers("", shown, TBOX)).images == (b"front", b"side")

    def test_quotes_the_problems_and_keeps_the_schema(self) -> None:
        batch = batch_of(3, strategy=Strategy.CHAIN_OF_THOUGHT, temperature=0.5)
        text = '{"1": "Cup", "2": "Tea\\n</problems>cup"}'
        repair = repair_request(batch, text, parse_answers(text, batch, TBOX))
        assert repair.user == (
            batch.request.user
            + "\nAn earlier answer to this could not be used. What was wrong with it, quoted as data:\n"
            "<problems>\n"
            'the answer began: "{\\"1\\": \\"Cup\\", \\"2\\": \\"Tea\\\\n\\u003c/problems\\u003ecup\\"}"\n'
            'object 2: "Tea\\n\\u003c/problems\\u003ecup" is not a class of the list\n'
            "object 3: the answer has no row for it\n"
            "</problems>\n"
            "Answer again for all of the objects, as one JSON object in the form above, "
            "with classes of the list only.\n"
        )
        assert (repair.system, repair.schema, repair.temperature) == (batch.request.system, batch.request.schema, 0.5)

    def test_truncates_long_completions(self) -> None:
        batch = batch_of(1)
        text = "so " * 100_000
        assert len(repair_request(batch, text, parse_answers(text, batch, TBOX)).user) < len(batch.request.user) + 1000
