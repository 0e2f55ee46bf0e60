"""Prices against values calculated by hand from the list prices of the installed genai-prices."""

import socket
from decimal import Decimal

import genai_prices
import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Usage
from usd2kg.grounding.llm.prices import discount_batch, find_tariff, parse_price


@pytest.fixture(autouse=True)
def no_network(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("prices must not require the network")

    monkeypatch.setattr(socket.socket, "connect", refuse)


class TestListPrices:
    @pytest.mark.parametrize(
        ("model", "paid_in", "cached", "paid_out"),
        [
            ("google:gemini-2.5-flash", "0.30", "0.03", "2.50"),
            ("anthropic:claude-haiku-4-5", "1", "0.10", "5"),
            ("openai:gpt-4o", "2.50", "1.25", "10"),
            ("openai:openai/gpt-4o@https://openrouter.ai/api/v1", "2.50", "1.25", "10"),
        ],
    )
    def test_input_cached_input_and_output_have_separate_prices(
        self, model: str, paid_in: str, cached: str, paid_out: str
    ):
        tariff = find_tariff(model)

        assert tariff is not None
        assert tariff(Usage(1000, 0, 0)) == Decimal(paid_in) / 1000
        assert tariff(Usage(1000, 1000, 0)) == Decimal(cached) / 1000
        assert tariff(Usage(0, 0, 1000)) == Decimal(paid_out) / 1000
        expected = 600 * Decimal(paid_in) + 400 * Decimal(cached) + 50 * Decimal(paid_out)
        assert tariff(Usage(1000, 400, 50)) == expected / 1_000_000

    def test_writing_to_the_cache_of_anthropic_costs_25_percent_more(self):
        tariff = find_tariff("anthropic:claude-haiku-4-5")

        assert tariff is not None
        assert tariff(Usage(1000, 0, 0, written_tokens=1000)) == Decimal("0.00125")

    def test_the_price_per_token_depends_on_the_prompt_length(self):
        """Gemini 2.5 Pro costs twice as much per token from 200,000 tokens on."""
        tariff = find_tariff("google:gemini-2.5-pro")

        assert tariff is not None
        assert tariff(Usage(300_000)) > 2 * tariff(Usage(150_000))

    def test_limits_cached_tokens_to_the_input_tokens(self):
        tariff = find_tariff("openai:gpt-4o")

        assert tariff is not None
        assert tariff(Usage(1000, 5000, 0, written_tokens=7)) == tariff(Usage(1000, 1000, 0))

    @pytest.mark.parametrize(
        "model",
        [
            "openai:gpt-4o@http://localhost:8000/v1",
            "google:gemini-2.5-flash@http://127.0.0.1:1",
            "openai:a-model-that-nobody-heard-of",
            "gguf:/models/qwen.gguf",
            "test:model",
        ],
    )
    def test_local_servers_and_weights_have_no_list_price(self, model: str):
        assert find_tariff(model) is None

    def test_equals_the_price_of_genai_prices(self):
        listed = genai_prices.calc_price(
            genai_prices.Usage(input_tokens=123, output_tokens=45), "gpt-4o", provider_id="openai"
        )
        tariff = find_tariff("openai:gpt-4o")

        assert tariff is not None
        assert tariff(Usage(123, 0, 45)) == listed.total_price


class TestStatedPrices:
    def test_prices_are_per_million_tokens(self):
        tariff = parse_price("0.30/2.50")

        assert tariff(Usage(1_000_000, 400_000, 100_000)) == Decimal("0.55")
        assert tariff(Usage(1, 0, 1)) == Decimal("0.0000028")
        assert parse_price("0/0")(Usage(5, 0, 5)) == 0

    @pytest.mark.parametrize("text", ["", "1", "1/2/3", "a/b", "-1/2", "nan/1", "1/inf", "0,3/2,5"])
    def test_rejects_malformed_prices(self, text: str):
        with pytest.raises(GroundingError, match="expected INPUT/OUTPUT in dollars per million tokens"):
            parse_price(text)


class TestBatchPrices:
    def test_input_and_output_cost_half(self):
        tariff = find_tariff("anthropic:claude-haiku-4-5", is_batched=True)

        assert tariff is not None
        assert tariff(Usage(1000, 0, 0)) == Decimal("0.0005")
        assert tariff(Usage(0, 0, 1000)) == Decimal("0.0025")

    def test_a_listed_price_takes_precedence_over_the_rule(self):
        """Batch jobs of Gemini 2.5 Flash cost half, but its cached input costs the same."""
        tariff = find_tariff("google:gemini-2.5-flash", is_batched=True)

        assert tariff is not None
        assert tariff(Usage(0, 0, 1000)) == Decimal("0.00125")
        assert tariff(Usage(1000, 1000, 0)) == Decimal("0.00003")

    def test_models_without_a_listed_batch_price_follow_the_rule(self):
        single, batched = (
            find_tariff("google:gemini-2.0-flash", is_batched=is_batched) for is_batched in (False, True)
        )

        assert single is not None and batched is not None
        assert batched(Usage(1000, 0, 1000)) == single(Usage(1000, 0, 1000)) / 2

    def test_half_of_a_stated_price_is_counted(self):
        assert discount_batch(parse_price("1/2"))(Usage(1000, 0, 1000)) == Decimal("0.0015")
