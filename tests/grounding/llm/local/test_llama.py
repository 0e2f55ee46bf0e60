"""LlamaModel with a fake llama.cpp that keeps its KV cache as a list of tokens."""

import ctypes
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.local.llama import LlamaModel
from usd2kg.grounding.llm.local.tokenizer import Prompt

VOCABULARY = 8
WINDOW = 4096


class FakeLibrary:
    """A fake llama.cpp, whose first logit is a hash of the cached tokens."""

    __version__ = "0.0"
    llama_token = ctypes.c_int32
    LLAMA_FLASH_ATTN_TYPE_DISABLED = 0

    def __init__(self, *, is_readable: bool = True, is_recurrent: bool = False, has_memory: bool = True) -> None:
        self.is_readable, self.is_recurrent, self.has_memory = is_readable, is_recurrent, has_memory
        self.held: list[int] = []
        self.decoded: list[list[int]] = []
        """The batches that were read."""
        self.contexts: list[int] = []
        """Sizes of the contexts."""
        self.alive: set[str] = set()

    def llama_backend_init(self) -> None: ...

    def llama_model_default_params(self) -> None: ...

    def llama_model_load_from_file(self, path: bytes, settings: None) -> str | None:
        self.alive |= {"model"} if self.is_readable else set()
        return "model" if self.is_readable else None

    def llama_model_free(self, model: str) -> None:
        assert "context" not in self.alive
        self.alive.remove("model")

    def llama_model_has_encoder(self, model: str) -> bool:
        return False

    llama_model_is_hybrid = llama_model_has_encoder

    def llama_model_is_recurrent(self, model: str) -> bool:
        return self.is_recurrent

    def llama_model_n_ctx_train(self, model: str) -> int:
        return WINDOW

    def llama_model_get_vocab(self, model: str) -> str:
        return "vocabulary"

    def llama_vocab_n_tokens(self, vocabulary: str) -> int:
        return VOCABULARY

    def llama_token_to_piece(self, vocabulary: str, token: int, buffer: Any, *rest: Any) -> int:
        buffer[0] = 97 + token
        return 1

    def llama_batch_init(self, size: int, *rest: int) -> SimpleNamespace:
        columns = {name: [0] * size for name in ("token", "pos", "n_seq_id", "logits")}
        return SimpleNamespace(n_tokens=0, seq_id=[[0] for _ in range(size)], **columns)

    def llama_batch_free(self, batch: SimpleNamespace) -> None: ...

    def llama_supports_gpu_offload(self) -> bool:
        return False

    def llama_context_default_params(self) -> SimpleNamespace:
        return SimpleNamespace()

    def llama_init_from_model(self, model: str, settings: SimpleNamespace) -> str | None:
        if not self.has_memory:
            return None
        assert "context" not in self.alive and settings.n_threads == settings.n_threads_batch == 3
        assert settings.flash_attn_type == self.LLAMA_FLASH_ATTN_TYPE_DISABLED
        self.alive.add("context")
        self.contexts.append(settings.n_ctx)
        self.held = []
        return "context"

    def llama_free(self, context: str) -> None:
        self.alive.remove("context")

    def llama_get_memory(self, context: str) -> str:
        return "memory"

    def llama_memory_seq_rm(self, memory: str, sequence: int, start: int, end: int) -> bool:
        del self.held[start:]
        return True

    def llama_decode(self, context: str, batch: SimpleNamespace) -> int:
        count = batch.n_tokens
        assert batch.pos[:count] == list(range(len(self.held), len(self.held) + count))
        assert batch.logits[:count] == [False] * (count - 1) + [True]
        if len(self.held) + count > self.contexts[-1]:
            return 1
        self.held += batch.token[:count]
        self.decoded.append(batch.token[:count])
        return 0

    def llama_get_logits_ith(self, context: str, place: int) -> Any:
        found = (ctypes.c_float * VOCABULARY)(*range(VOCABULARY))
        found[0] = hash(tuple(self.held)) % 9973
        return ctypes.cast(found, ctypes.POINTER(ctypes.c_float))


def open_model(**how: bool) -> tuple[LlamaModel, FakeLibrary]:
    library = FakeLibrary(**how)
    return LlamaModel(library, Path("model.gguf"), 3), library  # type: ignore[arg-type]


def tokens(*counts: int) -> tuple[int, ...]:
    """Return `counts[0]` times token 1, `counts[1]` times token 2, and so on."""
    return tuple(token for token, count in enumerate(counts, start=1) for _ in range(count))


class TestReading:
    def test_reads_only_the_user_prompt_of_a_second_prompt(self):
        model, library = open_model()
        assert model.read_prompt(Prompt(tokens(600), tokens(0, 5)), 10) == 0
        assert [len(piece) for piece in library.decoded] == [512, 88, 5]
        model.logits([1, 2])
        assert model.read_prompt(Prompt(tokens(600), tokens(0, 0, 7)), 10) == 600
        assert library.decoded[-1] == [3] * 7
        assert library.held == [*tokens(600, 0, 7)]

    def test_keeps_whole_batches(self):
        model, library = open_model()
        model.read_prompt(Prompt(tokens(600), tokens(0, 600)), 10)
        # Equal up to token 600 + 550, which includes one whole batch of the user prompt.
        assert model.read_prompt(Prompt(tokens(600), tokens(0, 550, 50)), 10) == 600 + 512
        assert library.decoded[-1] == [*tokens(0, 38, 50)]

    def test_keeps_nothing_of_another_system_prompt(self):
        model, library = open_model()
        model.read_prompt(Prompt(tokens(100), tokens(0, 5)), 10)
        assert model.read_prompt(Prompt(tokens(99, 1), tokens(0, 5)), 10) == 0
        assert library.held == [*tokens(99, 1), *tokens(0, 5)]

    def test_keeps_an_equal_prompt_without_its_completion(self):
        model, library = open_model()
        prompt = Prompt(tokens(10), tokens(0, 5))
        model.read_prompt(prompt, 10)
        model.logits([7, 7, 7])
        assert model.read_prompt(prompt, 10) == 15
        assert library.held == [*prompt.tokens]

    def test_logits_do_not_depend_on_the_previous_prompt(self):
        prompt = Prompt(tokens(700), tokens(0, 700))
        model, library = open_model()
        model.read_prompt(Prompt(tokens(700), tokens(0, 600, 50)), 10)
        model.read_prompt(prompt, 10)
        other, fresh = open_model()
        other.read_prompt(prompt, 10)
        assert model.logits([1]).tolist() == other.logits([1]).tolist()
        assert library.decoded[-2:] == fresh.decoded[-2:]


class TestLogits:
    def test_depend_only_on_prompt_and_generated_tokens(self):
        model, library = open_model()
        model.read_prompt(Prompt(tokens(3), ()), 10)
        for generated in ([1], [1, 2], [1, 2, 3], [1, 4], [1], [1]):
            assert model.logits(generated)[0] == hash((1, 1, 1, *generated)) % 9973
            assert library.held == [1, 1, 1, *generated]

    def test_read_only_new_tokens(self):
        model, library = open_model()
        model.read_prompt(Prompt(tokens(3), ()), 10)
        library.decoded.clear()
        for generated in ([1, 2], [1, 2, 3], [1, 2, 4], [1, 2, 4]):
            model.logits(generated)
        assert library.decoded == [[1, 2], [3], [4], [4]]


class TestContext:
    def test_grows_in_powers_of_two_up_to_the_window(self):
        model, library = open_model()
        for size in (10, 2000, 2100, 100, 4000):
            model.read_prompt(Prompt((), tokens(size)), 10)
        assert library.contexts == [2048, 4096]
        assert model.read_prompt(Prompt((), tokens(4000)), 90) == 4000

    def test_a_new_context_is_empty(self):
        model, library = open_model()
        model.read_prompt(Prompt(tokens(1000), ()), 10)
        assert model.read_prompt(Prompt(tokens(1000), tokens(0, 2000)), 10) == 0
        assert len(library.held) == 3000

    def test_reports_insufficient_memory(self):
        model, _ = open_model(has_memory=False)
        with pytest.raises(GroundingError, match=r"^model\.gguf: no memory for a context of 4096 tokens;"):
            model.read_prompt(Prompt((), tokens(3000)), 10)

    def test_reports_a_full_context(self):
        model, _ = open_model()
        model.read_prompt(Prompt((), tokens(2000)), 48)
        with pytest.raises(GroundingError, match=r"^model\.gguf: llama\.cpp failed with status 1 after 2000 tokens$"):
            model.logits(tokens(49))


class TestLoading:
    def test_reports_weights_that_cannot_be_loaded(self):
        with pytest.raises(GroundingError, match=r"^model\.gguf: llama\.cpp \(llama-cpp-python 0\.0\) cannot load it"):
            open_model(is_readable=False)

    def test_rejects_and_frees_recurrent_models(self):
        library = FakeLibrary(is_recurrent=True)
        with pytest.raises(GroundingError, match="expected a pure attention decoder"):
            LlamaModel(library, Path("model.gguf"), 1)  # type: ignore[arg-type]
        assert library.alive == set()

    def test_closing_frees_the_context_before_the_model(self):
        model, library = open_model()
        model.read_prompt(Prompt((), tokens(10)), 10)
        model.close()
        model.close()
        assert library.alive == set()
