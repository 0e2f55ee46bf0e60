"""LocalClient with a fake model."""

import json
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from tests.grounding.llm.local.fake_xllamacpp import FakeXllamacpp
from tests.grounding.llm.local.fakes import FakeModel, Probabilities
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Finish, Request, Usage
from usd2kg.grounding.llm.factory import LLMSettings, open_llm_grounder
from usd2kg.grounding.llm.local.client import LocalClient, is_local_model, open_local
from usd2kg.grounding.llm.local.library import import_library

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
"""Each byte is a token, and so is each class name."""


def cups(text: str) -> Probabilities:
    return {"Cup": 1.0} if text.endswith('"class": "') else {'"': 1.0}


def make_model(window: int = 10_000) -> FakeModel:
    return FakeModel(cups, "Cup", "Knife", window=window)


def connect(model: FakeModel) -> LocalClient:
    return LocalClient("gguf:fake.gguf", lambda: model)


class TestComplete:
    def test_returns_answer_tokens_and_usage(self):
        model = make_model()
        with connect(model) as client:
            first, second = client.complete(REQUEST), client.complete(replace(REQUEST, user="Others."))
        assert (first.text, first.finish) == (ANSWER, Finish.STOP)
        assert "".join(text for text, _ in first.tokens) == ANSWER
        assert first.usage == Usage(20, 0, ANSWER_TOKENS)
        assert second.usage.cached_tokens == len("[Classes.]")

    def test_reserves_only_the_tokens_of_the_answer(self):
        model = make_model()
        with connect(model) as client:
            client.complete(REQUEST)
            client.complete(replace(REQUEST, max_tokens=40))
        assert [room for _, room in model.prompts] == [ANSWER_TOKENS, 40]

    def test_omits_rows_beyond_the_token_limit_or_the_window(self):
        for window, max_tokens in ((10_000, 40), (20 + 40, 4096)):
            with connect(make_model(window)) as client:
                completion = client.complete(replace(REQUEST, max_tokens=max_tokens))
            assert (json.loads(completion.text), completion.finish) == ({"1": {"class": "Cup"}}, Finish.LENGTH)

    def test_reports_a_prompt_that_does_not_fit_the_window(self):
        with (
            connect(make_model(window=20 + 20)) as client,
            pytest.raises(GroundingError) as error,
        ):
            client.complete(REQUEST)
        assert str(error.value) == (
            "model 'gguf:fake.gguf': the prompt has 20 tokens and its answer 21 or more, but the model reads 40 at "
            "most; offer fewer classes with --shortlist, or ask about fewer objects a prompt with --objects-per-prompt"
        )

    def test_rejects_thinking(self):
        with connect(make_model()) as client, pytest.raises(GroundingError, match="leave out --thinking"):
            client.complete(replace(REQUEST, is_thinking=True))

    def test_loads_the_weights_once_on_demand(self):
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

            def logits(self, generated):
                time.sleep(0.001)
                assert self.asker == threading.get_ident()
                return super().logits(generated)

        with connect(Watched(cups, "Cup", "Knife")) as client, ThreadPoolExecutor(8) as pool:
            found = list(pool.map(client.complete, [REQUEST] * 8))
        assert {completion.text for completion in found} == {ANSWER}


class TestOpen:
    @pytest.fixture(autouse=True)
    def library(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "llama_cpp", type(sys)("llama_cpp"))
        monkeypatch.setitem(sys.modules, "xllamacpp", None)

    def test_recognises_the_scheme_gguf(self):
        assert is_local_model("gguf:model.gguf")
        assert not is_local_model("openai:gguf")

    def test_reports_a_missing_file(self, tmp_path: Path):
        with pytest.raises(GroundingError, match=r"none\.gguf: the weights cannot be read \(No such file"):
            open_local(f"gguf:{tmp_path}/none.gguf")

    def test_reports_a_file_in_another_format(self, tmp_path: Path):
        path = tmp_path / "model.gguf"
        path.write_bytes(b"PK\x03\x04 and more")
        with pytest.raises(GroundingError, match=r"model\.gguf: is not a GGUF file, it begins with b'PK"):
            open_local(f"gguf:{path}")

    def test_expands_the_home_folder(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setenv("HOME", str(tmp_path))
        (tmp_path / "model.gguf").write_bytes(b"GGUF")
        assert open_local("gguf:~/model.gguf").model == "gguf:~/model.gguf"

    def test_uses_the_compiled_library_if_both_are_installed(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "xllamacpp", type(sys)("xllamacpp"))
        assert import_library("gguf:m.gguf").__name__ == "llama_cpp"

    def test_uses_the_prebuilt_library_otherwise(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "llama_cpp", None)
        library = FakeXllamacpp(cups, "Cup", "Knife")
        monkeypatch.setitem(sys.modules, "xllamacpp", library)
        path = tmp_path / "model.gguf"
        path.write_bytes(b"GGUF")
        with open_local(f"gguf:{path}", threads=2) as client:
            assert client.complete(REQUEST).text == ANSWER
        assert library.servers[0].settings.cpuparams.n_threads == 2

    def test_reports_the_missing_extra(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "llama_cpp", None)
        with pytest.raises(GroundingError, match=r"^model 'gguf:m\.gguf': .* run pip install 'usd2kg\[gguf\]'$"):
            open_local("gguf:m.gguf")

    def test_a_dry_run_needs_neither_library_nor_file(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "llama_cpp", None)
        with open_llm_grounder(LLMSettings("gguf:m.gguf"), is_dry=True) as grounder:
            assert grounder.settings["model"] == "gguf:m.gguf"
