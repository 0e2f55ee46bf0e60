"""ServerModel, ServerTokenizer and LlamaServer with a fake xllamacpp."""

import math
import urllib.error
import urllib.request
from pathlib import Path

import numpy as np
import pytest

from tests.grounding.llm.local.fake_xllamacpp import WINDOW, FakeXllamacpp
from tests.grounding.llm.local.fakes import Probabilities
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Request, Usage
from usd2kg.grounding.llm.local.client import LocalClient
from usd2kg.grounding.llm.local.server import NextToken
from usd2kg.grounding.llm.local.server_model import ServerModel, spread_rest
from usd2kg.grounding.llm.local.server_tokenizer import has_chat_template
from usd2kg.grounding.llm.local.tokenizer import Prompt

NAMES = ["Cup", "Knife"]
SCHEMA = {
    "type": "object",
    "properties": {"1": {"type": "object", "properties": {"class": {"type": "string", "enum": NAMES}}}},
}


def knives(text: str) -> Probabilities:
    return {"Knife": 0.5, "Cup": 0.25} if text.endswith('"class": "') else {'"': 0.9}


@pytest.fixture
def weights(tmp_path: Path) -> Path:
    path = tmp_path / "model.gguf"
    path.write_bytes(b"GGUF and tokenizer.chat_template and more")
    return path


@pytest.fixture
def library() -> FakeXllamacpp:
    return FakeXllamacpp(knives, *NAMES)


@pytest.fixture
def model(library: FakeXllamacpp, weights: Path) -> ServerModel:
    return ServerModel(library, weights, 3)


def prompt(shared: str, own: str) -> Prompt:
    return Prompt(tuple(shared.encode()), tuple(own.encode()))


class TestCompletion:
    def test_is_the_most_probable_offered_name_with_its_share(self, library: FakeXllamacpp, weights: Path):
        with LocalClient("gguf:model.gguf", lambda: ServerModel(library, weights, 1)) as client:
            first = client.complete(Request(system="Classes.", user="Objects.", schema=SCHEMA))
            second = client.complete(Request(system="Classes.", user="Others.", schema=SCHEMA))
        assert first.text == second.text == '{"1": {"class": "Knife"}}'
        assert math.exp(sum(logprob for _, logprob in first.tokens)) == pytest.approx(2 / 3, rel=1e-4)
        shared = len("Classes.") + 2
        assert first.usage == Usage(shared + len("Objects.") + 1, 0, len(first.tokens))
        assert second.usage.cached_tokens == shared

    def test_equals_an_earlier_one_to_the_same_prompt(self, library: FakeXllamacpp, weights: Path):
        request = Request(system="Classes.", user="Objects.", schema=SCHEMA)
        with LocalClient("gguf:model.gguf", lambda: ServerModel(library, weights, 1)) as client:
            first, again = client.complete(request), client.complete(request)
        assert (first.text, first.tokens) == (again.text, again.tokens)
        assert again.usage.cached_tokens == again.usage.input_tokens


class TestReading:
    @pytest.mark.parametrize("before", [[], [("abc", "xyz")], [("abc", "xy")], [("ab", "cxy")], [("abc", "xyzz")]])
    def test_batches_do_not_depend_on_earlier_prompts(
        self, library: FakeXllamacpp, model: ServerModel, before: list[tuple[str, str]]
    ):
        for shared, own in before:
            model.read_prompt(prompt(shared, own), 10)
            model.logits([1, 2])
        model.read_prompt(prompt("abc", "xyz"), 10)
        assert library.servers[-1].cache == [(97, 3), (98, 3), (99, 1), (120, 3), (121, 3), (122, 1)]

    def test_returns_the_cached_tokens(self, model: ServerModel):
        asked = [("abc", "xyz"), ("abc", "xy"), ("abc", "xy"), ("ab", "xy")]
        assert [model.read_prompt(prompt(*one), 10) for one in asked] == [0, 3, 5, 0]

    def test_the_context_grows_with_an_empty_cache(self, library: FakeXllamacpp, model: ServerModel):
        model.read_prompt(prompt("abc", "xyz"), 10)
        assert model.read_prompt(prompt("abc", "xyz"), 3000) == 0
        assert [one.settings.n_ctx for one in library.servers] == [2048, 4096]
        assert model.window == WINDOW


class TestLogits:
    def test_follow_prompt_and_generated_tokens(self, library: FakeXllamacpp, model: ServerModel):
        model.read_prompt(prompt("abc", '"class": '), 10)
        logprobs = model.logits([ord('"')])
        assert logprobs.shape == (library.size,)
        assert [logprobs[library.tokens.token(name)] for name in NAMES] == pytest.approx(
            [math.log(0.25), math.log(0.5)]
        )

    def test_spread_the_rest_over_the_other_tokens(self):
        found = [NextToken(3, b"c", math.log(0.6)), NextToken(1, b"a", math.log(0.2))]
        assert np.exp(spread_rest(found, 6)) == pytest.approx([0.05, 0.2, 0.05, 0.6, 0.05, 0.05])

    def test_no_other_token_is_more_probable_than_those_found(self):
        found = [NextToken(0, b"a", math.log(0.5)), NextToken(1, b"b", math.log(0.1))]
        assert np.exp(spread_rest(found, 3)) == pytest.approx([0.5, 0.1, 0.1])

    def test_are_finite_if_rounding_leaves_no_rest(self):
        assert np.isfinite(spread_rest([NextToken(0, b"a", 0.0)], 2)).all()


class TestTokenizer:
    def test_reads_the_pieces_and_control_tokens(self, library: FakeXllamacpp, model: ServerModel):
        assert model.tokenizer.pieces == [library.spell(token) for token in range(library.size)]
        assert model.tokenizer.ends == {0, *library.controls.values()}

    def test_marks_in_a_prompt_are_plain_text(self, library: FakeXllamacpp, model: ServerModel):
        found = model.tokenizer.encode_prompt("Do.", "a cup </ask>")
        marks = [token for token in found.tokens if token in library.controls.values()]
        assert marks == [library.controls[mark] for mark in ("<sys>", "</sys><ask>", "</ask>")]
        assert bytes(found.own[:-1]) == b"a cup </ask>"

    def test_begins_with_the_token_that_the_model_expects(self, weights: Path):
        library = FakeXllamacpp(knives, has_begin=True)
        weights.write_bytes(b"GGUF without a template")
        found = ServerModel(library, weights, 1).tokenizer.encode_prompt("Do.", "a cup")
        begin = library.controls["<sys>"]
        assert found.shared == (begin, *b"Do.\n\n")
        assert bytes(found.own) == b"a cup\n\nAnswer:\n"

    def test_asks_once_for_each_text(self, library: FakeXllamacpp, model: ServerModel):
        first = model.tokenizer.tokenize("Knife and more")
        asked = len(library.servers[0].paths)
        assert model.tokenizer.tokenize("Knife and more") == first
        assert len(library.servers[0].paths) == asked

    def test_finds_a_chat_template(self, weights: Path):
        assert has_chat_template(weights)
        weights.write_bytes(b"GGUF without one")
        assert not has_chat_template(weights)


class TestServer:
    def test_has_one_slot_and_threads_as_asked(self, library: FakeXllamacpp, model: ServerModel, weights: Path):
        settings = library.servers[0].settings
        assert (settings.model.path, settings.n_parallel, settings.cpuparams.n_threads) == (str(weights), 1, 3)
        assert (settings.n_batch, settings.n_ubatch, settings.cache_ram_mib) == (512, 512, 0)
        assert settings.flash_attn_type == "no flash attention"

    def test_a_graphics_card_may_use_flash_attention(self, weights: Path):
        library = FakeXllamacpp(knives, devices=(0, 1))
        ServerModel(library, weights, 1)
        assert not hasattr(library.servers[0].settings, "flash_attn_type")

    def test_answers_nobody_without_its_key(self, library: FakeXllamacpp, model: ServerModel):
        server = library.servers[0]
        assert server.settings.hostnames == ["127.0.0.1"] and len(server.settings.api_keys[0]) >= 32
        with pytest.raises(urllib.error.HTTPError, match="401") as error:
            urllib.request.urlopen(f"{server.listening_address}/v1/models", timeout=10)
        error.value.close()

    def test_reports_weights_that_cannot_be_loaded(self, weights: Path):
        with pytest.raises(GroundingError, match=r"model\.gguf: llama\.cpp \(xllamacpp 0\.0\) cannot load it with"):
            ServerModel(FakeXllamacpp(knives, is_readable=False), weights, 1)

    def test_reports_insufficient_memory(self, weights: Path):
        model = ServerModel(FakeXllamacpp(knives, memory=2048), weights, 1)
        with pytest.raises(GroundingError, match="a context of 4096 tokens"):
            model.read_prompt(prompt("abc", "xyz"), 3000)

    def test_reports_a_full_context(self, model: ServerModel):
        model.read_prompt(prompt("abc", "xyz"), 10)
        with pytest.raises(GroundingError, match=r"llama\.cpp failed after 2106 tokens: .* available context size"):
            model.logits([65] * 2100)

    def test_reports_a_request_that_it_rejects(self, model: ServerModel):
        with pytest.raises(GroundingError, match=r"server answers 400 at /nothing: .*cannot do"):
            model._server.post("/nothing", {})

    def test_is_gone_after_closing(self, library: FakeXllamacpp, model: ServerModel):
        model.close()
        assert model._server._server is None
