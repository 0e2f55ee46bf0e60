"""Weights that llama.cpp holds in memory: what may follow a prompt, and the cache of what was read.

What a model says depends on a request alone, not on those before it: prompts are read in pieces whose borders depend on
the prompt only, and pieces are kept or dropped whole, as the last bits of a number depend on how much is read at once.
"""

import weakref
from collections.abc import Sequence
from contextlib import ExitStack
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import numpy.typing as npt

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.local.tokenizer import Prompt, Tokenizer

__all__ = ["LlamaModel"]

_PIECE = 512
"""Tokens that are read at once."""
_LEAST_CONTEXT = 2048


class LlamaModel:
    """One model in memory, for one thread at a time. All methods raise GroundingError where llama.cpp gives up."""

    def __init__(self, library: ModuleType, path: Path, threads: int) -> None:
        """Load the weights.

        Raises:
            GroundingError: llama.cpp cannot load them, or it is no model that writes text token by token.
        """
        self._library, self._path, self._threads = library, path, threads
        self._stack = ExitStack()
        """What is to be freed, the last first."""
        self._free = weakref.finalize(self, self._stack.close)
        self._model = self._load()
        self.tokenizer = Tokenizer(library, self._model)
        self.window: int = library.llama_model_n_ctx_train(self._model)
        """Tokens that the model was trained to read at once."""
        self._batch = library.llama_batch_init(_PIECE, 0, 1)
        self._stack.callback(library.llama_batch_free, self._batch)
        self._context_stack = self._stack.enter_context(ExitStack())
        self._context: Any = None
        self._size = 0
        self._held: list[int] = []
        """Tokens in the cache."""
        self._prompt = Prompt((), ())

    def close(self) -> None:
        """Free the memory; the model can no longer be used."""
        self._free()

    def begin(self, prompt: Prompt, room: int) -> int:
        """Read a prompt, and return how many of its tokens were still there from the last one.

        Args:
            prompt: what to read.
            room: tokens that may follow.
        """
        self._reserve(len(prompt.tokens) + room)
        kept, borders = self._kept(prompt), _borders(prompt)
        self._prompt = Prompt((), ())
        self._forget(kept)
        for start, end in pairwise(border for border in borders if border >= kept):
            self._read(prompt.tokens[start:end])
        self._prompt = prompt
        return kept

    def logits(self, said: Sequence[int]) -> npt.NDArray[np.float32]:
        """Return the model's output behind the prompt and at least one token more: one number for every next token."""
        start = len(self._prompt.tokens)
        same = _count_same(self._held[start:], said[:-1])
        self._forget(start + same)
        for place in range(same, len(said), _PIECE):
            self._read(said[place : place + _PIECE])
        found = self._library.llama_get_logits_ith(self._context, -1)
        return np.ctypeslib.as_array(found, shape=(len(self.tokenizer.pieces),)).copy()

    def _load(self) -> Any:
        library = self._library
        library.llama_backend_init()
        model = library.llama_model_load_from_file(str(self._path).encode(), library.llama_model_default_params())
        if not model:
            raise GroundingError(
                f"{self._path}: llama.cpp (llama-cpp-python {library.__version__}) cannot load it; expected a whole "
                "GGUF file of a model that it knows: fetch it anew, or update llama-cpp-python"
            )
        self._stack.callback(library.llama_model_free, model)
        others = (library.llama_model_has_encoder, library.llama_model_is_recurrent, library.llama_model_is_hybrid)
        if any(is_other(model) for is_other in others):
            raise GroundingError(
                f"{self._path}: is a model with an encoder or with states; expected a decoder with attention alone"
            )
        return model

    def _reserve(self, size: int) -> None:
        """Make the cache large enough for so many tokens; a new one is empty."""
        if size <= self._size:
            return
        self._context_stack.close()
        self._held, self._prompt, self._size = [], Prompt((), ()), 0
        size = min(max(_LEAST_CONTEXT, 1 << (size - 1).bit_length()), self.window)
        settings = self._library.llama_context_default_params()
        settings.n_ctx, settings.n_batch, settings.n_ubatch = size, _PIECE, _PIECE
        settings.n_threads = settings.n_threads_batch = self._threads
        self._context = self._library.llama_init_from_model(self._model, settings)
        if not self._context:
            raise GroundingError(
                f"{self._path}: no memory for a context of {size} tokens; offer fewer classes with --shortlist, "
                "or ask about fewer objects a prompt with --objects-per-prompt"
            )
        self._context_stack.callback(self._library.llama_free, self._context)
        self._size = size

    def _kept(self, prompt: Prompt) -> int:
        """Return how much of a prompt need not be read again: whole pieces that the last prompt had, too."""
        same = _count_same(self._held, prompt.tokens)
        borders = _borders(prompt)
        shared = borders[: _count_same(borders, _borders(self._prompt))]
        return max(border for border in shared if border <= same)

    def _forget(self, start: int) -> None:
        """Drop the tokens from a place on."""
        memory = self._library.llama_get_memory(self._context)
        # Even where nothing is held: reading that was broken off may have left tokens behind.
        if not self._library.llama_memory_seq_rm(memory, 0, start, -1):
            raise GroundingError(f"{self._path}: llama.cpp cannot drop tokens from this model's cache; use another one")
        del self._held[start:]

    def _read(self, tokens: Sequence[int]) -> None:
        """Read some tokens more; the output behind the last of them can be had."""
        batch, start = self._batch, len(self._held)
        batch.n_tokens = len(tokens)
        for place, token in enumerate(tokens):
            batch.token[place], batch.pos[place] = token, start + place
            batch.n_seq_id[place], batch.seq_id[place][0] = 1, 0
            batch.logits[place] = place == len(tokens) - 1
        status = self._library.llama_decode(self._context, batch)
        if status:
            raise GroundingError(f"{self._path}: llama.cpp gave up with status {status} after {start} tokens")
        self._held.extend(tokens)


def _borders(prompt: Prompt) -> list[int]:
    """Return where the pieces of a prompt begin that are read at once, and its end."""
    start, end = len(prompt.shared), len(prompt.tokens)
    return [*range(0, start, _PIECE), *range(start, end, _PIECE), end]


def _count_same(one: Sequence[int], other: Sequence[int]) -> int:
    """Return how many of the first tokens are the same."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((place for place, (a, b) in pairs if a != b), min(len(one), len(other)))
