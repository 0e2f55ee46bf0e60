"""LlamaModel: next-token logits from llama.cpp, with a KV cache that is shared between prompts.

A completion must not depend on earlier requests, but rounding depends on the size of the batches in which tokens are
read. So a prompt is divided into batches by its own tokens alone, and the cache keeps or drops whole batches.
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
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.local.context_size import context_size
from usd2kg.grounding.llm.local.llama_tokenizer import LlamaTokenizer
from usd2kg.grounding.llm.local.tokenizer import Prompt

__all__ = ["LlamaModel"]


class LlamaModel:
    """A loaded model, for one thread at a time. All methods raise GroundingError if llama.cpp fails."""

    def __init__(self, library: ModuleType, path: Path, threads: int) -> None:
        """Load the weights.

        Raises:
            GroundingError: llama.cpp cannot load them, or the model is not a pure attention decoder.
        """
        self._library, self._path, self._threads = library, path, threads
        self._stack = ExitStack()
        """Frees the resources of llama.cpp in reverse order."""
        self._free = weakref.finalize(self, self._stack.close)
        self._model = self._load()
        self.tokenizer = LlamaTokenizer(library, self._model)
        self.window: int = library.llama_model_n_ctx_train(self._model)
        """Size of the context window in tokens, as trained."""
        self._batch = library.llama_batch_init(LIMITS.decode_batch_tokens, 0, 1)
        self._stack.callback(library.llama_batch_free, self._batch)
        self._context_stack = self._stack.enter_context(ExitStack())
        self._context: Any = None
        self._context_size = 0
        self._cached: list[int] = []
        """Tokens in the KV cache."""
        self._prompt = Prompt((), ())

    def close(self) -> None:
        """Free the memory."""
        self._free()

    def read_prompt(self, prompt: Prompt, max_tokens: int) -> int:
        """Read a prompt and return how many of its tokens were cached from the previous one.

        Args:
            prompt: the prompt.
            max_tokens: tokens to reserve for the completion.
        """
        self._reserve(len(prompt.tokens) + max_tokens)
        kept, borders = self._cached_tokens(prompt), _batch_borders(prompt)
        self._prompt = Prompt((), ())
        self._forget(kept)
        for start, end in pairwise(border for border in borders if border >= kept):
            self._read(prompt.tokens[start:end])
        self._prompt = prompt
        return kept

    def logits(self, generated: Sequence[int]) -> npt.NDArray[np.float32]:
        """Return the logits of the next token after the prompt and at least one generated token: (vocabulary,)."""
        start = len(self._prompt.tokens)
        same = _common_prefix(self._cached[start:], generated[:-1])
        self._forget(start + same)
        for position in range(same, len(generated), LIMITS.decode_batch_tokens):
            self._read(generated[position : position + LIMITS.decode_batch_tokens])
        logits = self._library.llama_get_logits_ith(self._context, -1)
        return np.ctypeslib.as_array(logits, shape=(len(self.tokenizer.pieces),)).copy()

    def _load(self) -> Any:
        library = self._library
        library.llama_backend_init()
        model = library.llama_model_load_from_file(str(self._path).encode(), library.llama_model_default_params())
        if not model:
            raise GroundingError(
                f"{self._path}: llama.cpp (llama-cpp-python {library.__version__}) cannot load it; expected a complete "
                "GGUF file of a supported model: download it again, or update llama-cpp-python"
            )
        self._stack.callback(library.llama_model_free, model)
        unsupported = (library.llama_model_has_encoder, library.llama_model_is_recurrent, library.llama_model_is_hybrid)
        if any(is_unsupported(model) for is_unsupported in unsupported):
            raise GroundingError(
                f"{self._path}: is a model with an encoder or a recurrent state; expected a pure attention decoder"
            )
        return model

    def _reserve(self, size: int) -> None:
        """Ensure a context of at least `size` tokens; a new context has an empty cache."""
        if size <= self._context_size:
            return
        self._context_stack.close()
        self._cached, self._prompt, self._context_size = [], Prompt((), ()), 0
        size = context_size(size, self.window)
        settings = self._library.llama_context_default_params()
        settings.n_ctx, settings.n_batch, settings.n_ubatch = (
            size,
            LIMITS.decode_batch_tokens,
            LIMITS.decode_batch_tokens,
        )
        settings.n_threads = settings.n_threads_batch = self._threads
        # On processors, flash attention takes twice the time for a short text after a long cached one.
        if not self._library.llama_supports_gpu_offload():
            settings.flash_attn_type = self._library.LLAMA_FLASH_ATTN_TYPE_DISABLED
        self._context = self._library.llama_init_from_model(self._model, settings)
        if not self._context:
            raise GroundingError(
                f"{self._path}: no memory for a context of {size} tokens; offer fewer classes with --shortlist, "
                "or ask about fewer objects a prompt with --objects-per-prompt"
            )
        self._context_stack.callback(self._library.llama_free, self._context)
        self._context_size = size

    def _cached_tokens(self, prompt: Prompt) -> int:
        """Return how many tokens of a prompt are cached: whole batches that the previous prompt shares."""
        same = _common_prefix(self._cached, prompt.tokens)
        borders = _batch_borders(prompt)
        shared = borders[: _common_prefix(borders, _batch_borders(self._prompt))]
        return max(border for border in shared if border <= same)

    def _forget(self, start: int) -> None:
        """Remove the tokens from position `start` on from the cache."""
        memory = self._library.llama_get_memory(self._context)
        # Necessary even if `_cached` is shorter: an interrupted read may have left tokens in the cache.
        if not self._library.llama_memory_seq_rm(memory, 0, start, -1):
            raise GroundingError(
                f"{self._path}: llama.cpp cannot remove tokens from this model's cache; use another model"
            )
        del self._cached[start:]

    def _read(self, tokens: Sequence[int]) -> None:
        """Read tokens into the cache and compute the logits after the last one."""
        batch, start = self._batch, len(self._cached)
        batch.n_tokens = len(tokens)
        for index, token in enumerate(tokens):
            batch.token[index], batch.pos[index] = token, start + index
            batch.n_seq_id[index], batch.seq_id[index][0] = 1, 0
            batch.logits[index] = index == len(tokens) - 1
        status = self._library.llama_decode(self._context, batch)
        if status:
            raise GroundingError(f"{self._path}: llama.cpp failed with status {status} after {start} tokens")
        self._cached.extend(tokens)


def _batch_borders(prompt: Prompt) -> list[int]:
    """Return the start positions of the batches of a prompt, and its end."""
    start, end = len(prompt.shared), len(prompt.tokens)
    return [*range(0, start, LIMITS.decode_batch_tokens), *range(start, end, LIMITS.decode_batch_tokens), end]


def _common_prefix(one: Sequence[int], other: Sequence[int]) -> int:
    """Return the length of the common prefix."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((index for index, (a, b) in pairs if a != b), min(len(one), len(other)))
