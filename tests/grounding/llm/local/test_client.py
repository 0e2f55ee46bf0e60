"""The client of a model in this process, with a model made by hand."""

import json
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from tests.grounding.llm.local.fakes import FakeModel, Probabilities
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Finish, Request, Usage
from usd2kg.grounding.llm.factory import LLMSettings, open_llm_grounder
from usd2kg.grounding.llm.local.client import LocalClient, is_local_model, open_local

SCHEMA = {
    "type": "object",
    "properties": {
        number: {"type": "object", "properties": {"class": {"type": "string", "enum": ["Cup", "Knife"]}}}
        for number in ("1", "2")
    },
}
REQUEST = Request(system="Classes.", user="Objects.", schema=SCHEMA)
ANSWER = '{"1": {"class": "Cup"}, "2": {"class": "Cup"}}'
ANSWER_TOKENS = len(ANSWER) - 4
"""A token is a byte, but for the classes."""


def cups(text: str) -> Probabilities:
    return {"Cup": 1.0} if text.endswith('"class": "') else {'"': 1.0}


def make_model(window: int = 10_000) -> FakeModel:
    return FakeModel(cups, "Cup", "Knife", window=window)


def connect(model: FakeModel) -> LocalClient:
    return LocalClient("gguf:fake.gguf", lambda: model)


class TestComplete:
    def test_returns_the_answer_with_its_tokens_and_what_it_cost(self):
        model = make_model()
        with connect(model) as client:
            first, second = client.complete(REQUEST), client.complete(replace(REQUEST, user="Others."))
        assert (first.text, first.finish) == (ANSWER, Finish.STOP)
        assert "".join(text for text, _ in first.tokens) == ANSWER
        assert first.usage == Usage(20, 0, ANSWER_TOKENS)
        assert second.usage.cached_tokens == len("[Classes.]")

    def test_makes_room_for_the_answer_alone(self):
        model = make_model()
        with connect(model) as client:
            client.complete(REQUEST)
            client.complete(replace(REQUEST, max_tokens=40))
        assert [room for _, room in model.prompts] == [ANSWER_TOKENS, 40]

    def test_leaves_rows_out_where_the_output_is_limited_or_the_window_ends(self):
        for window, max_tokens in ((10_000, 40), (20 + 40, 4096)):
            with connect(make_model(window)) as client:
                completion = client.complete(replace(REQUEST, max_tokens=max_tokens))
            assert (json.loads(completion.text), completion.finish) == ({"1": {"class": "Cup"}}, Finish.LENGTH)

    def test_says_what_a_prompt_needs_where_the_window_is_too_small(self):
        with (
            connect(make_model(window=20 + 20)) as client,
            pytest.raises(GroundingError) as error,
        ):
            client.complete(REQUEST)
        assert str(error.value) == (
            "model 'gguf:fake.gguf': the prompt has 20 tokens and its answer 21 or more, but the model reads 40 at "
            "most; offer fewer classes with --shortlist, or ask about fewer objects a prompt with --objects-per-prompt"
        )

    def test_refuses_to_think_first(self):
        with connect(make_model()) as client, pytest.raises(GroundingError, match="leave out --thinking"):
            client.complete(replace(REQUEST, is_thinking=True))

    def test_loads_the_weights_once_and_when_they_are_needed(self):
        loaded: list[FakeModel] = []

        def load() -> FakeModel:
            loaded.append(make_model())
            return loaded[-1]

        with LocalClient("gguf:fake.gguf", load) as client:
            assert loaded == []
            client.complete(REQUEST)
            client.complete(REQUEST)
            assert len(loaded) == 1 and not loaded[0].is_closed
        assert loaded[0].is_closed

    def test_serves_one_request_at_a_time(self):
        class Watched(FakeModel):
            def read_prompt(self, prompt, max_tokens):
                self.asker = threading.get_ident()
                return super().read_prompt(prompt, max_tokens)

            def logits(self, said):
                time.sleep(0.001)
                assert self.asker == threading.get_ident()
                return super().logits(said)

        with connect(Watched(cups, "Cup", "Knife")) as client, ThreadPoolExecutor(8) as pool:
            found = list(pool.map(client.complete, [REQUEST] * 8))
        assert {completion.text for completion in found} == {ANSWER}


class TestOpen:
    @pytest.fixture(autouse=True)
    def library(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "llama_cpp", type(sys)("llama_cpp"))

    def test_names_of_models_in_this_process_begin_with_gguf(self):
        assert is_local_model("gguf:model.gguf")
        assert not is_local_model("openai:gguf")

    def test_a_missing_file_is_named(self, tmp_path: Path):
        with pytest.raises(GroundingError, match=r"none\.gguf: the weights cannot be read \(No such file"):
            open_local(f"gguf:{tmp_path}/none.gguf")

    def test_a_file_in_another_format_is_named(self, tmp_path: Path):
        path = tmp_path / "model.gguf"
        path.write_bytes(b"PK\x03\x04 and more")
        with pytest.raises(GroundingError, match=r"model\.gguf: is not a GGUF file, it begins with b'PK"):
            open_local(f"gguf:{path}")

    def test_a_file_may_be_in_the_home_folder(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setenv("HOME", str(tmp_path))
        (tmp_path / "model.gguf").write_bytes(b"GGUF")
        assert open_local("gguf:~/model.gguf").model == "gguf:~/model.gguf"

    def test_a_missing_library_names_the_extra(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "llama_cpp", None)
        with pytest.raises(GroundingError, match=r"^model 'gguf:m\.gguf': .* run pip install 'usd2kg\[local\]'$"):
            open_local("gguf:m.gguf")

    def test_a_dry_run_needs_neither_library_nor_file(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "llama_cpp", None)
        with open_llm_grounder(LLMSettings("gguf:m.gguf"), is_dry=True) as grounder:
            assert grounder.settings["model"] == "gguf:m.gguf"
