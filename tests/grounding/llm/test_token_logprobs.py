"""TokenLogprobs against sums calculated by hand."""

import pytest

from usd2kg.grounding.llm.token_logprobs import TokenLogprobs

TEXT = '{"1": {"class": "Cup"}}'
CUP = (17, 20)


def total(*tokens: tuple[str, float], text: str = TEXT, span: tuple[int, int] = CUP) -> float | None:
    return TokenLogprobs(text, tokens).sum_over(span)


def test_span_selects_the_class():
    assert TEXT[slice(*CUP)] == "Cup"


def test_sums_only_the_tokens_of_the_span():
    assert total(('{"1": {"class": "', -1), ("Cup", -0.25), ('"}}', -2)) == -0.25
    assert total(('{"1": {"class": "', -1), ("C", -0.25), ("up", -0.5), ('"}}', -2)) == -0.75


def test_counts_tokens_across_a_boundary_in_full():
    assert total(('{"1": {"class":', -1), (' "C', -0.25), ("u", -0.5), ('p"}', -0.125), ("}", -2)) == -0.875
    assert total((TEXT, -3)) == -3


def test_ignores_tokens_before_and_after_the_text():
    tokens = [("<think>", -9), (TEXT, -9), ("</think>\n", -9), (TEXT[:17], -1), ("Cup", -0.25), (TEXT[20:], -1)]
    assert total(*tokens, ("<|im_end|>", -9)) == -0.25


def test_counts_all_tokens_of_a_split_character():
    text = '"café"'
    tokens = ('"', -1), ("caf", -0.25), ("", -0.5), ("é", -0.125), ('"', -1)
    assert total(*tokens, text=text, span=(1, 5)) == -0.875
    assert total(*tokens, text=text, span=(1, 4)) == -0.25
    assert total(*tokens, text=text, span=(4, 5)) == -0.625


@pytest.mark.parametrize(
    "tokens",
    [(), ((TEXT[:-1], -1),), (("Ġ" + TEXT.replace(" ", "Ġ"), -1),), ((TEXT.upper(), -1),)],
)
def test_is_none_if_the_tokens_spell_another_text(tokens):
    assert total(*tokens) is None


def test_is_none_for_an_empty_span_or_text():
    assert total((TEXT, -1), span=(17, 17)) is None
    assert total(("Cup", -1), text="", span=(0, 0)) is None
