"""ServerModel: next-token log-probabilities from `LlamaServer`, with a KV cache that is shared between prompts.

A completion must not depend on earlier requests, but rounding depends on the batches in which tokens are read, and the
server always reads the last token of a request again. So system prompt and prompt are each read by a request of their
own and then once more: what the cache keeps for later prompts was read in the same batches whatever came before.
"""

import math
import sys
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.local.server import LlamaServer, NextToken
from usd2kg.grounding.llm.local.server_tokenizer import ServerTokenizer
from usd2kg.grounding.llm.local.tokenizer import Prompt

__all__ = ["ServerModel", "spread_rest"]

_NO_PROMPT = Prompt((), ())


class ServerModel:
    """A loaded model, for one thread at a time. All methods raise GroundingError if llama.cpp fails."""

    def __init__(self, library: ModuleType, path: Path, threads: int) -> None:
        """Load the weights.

        Raises:
            GroundingError: llama.cpp cannot load them.
        """
        self._server = LlamaServer(library, path, threads)
        self.tokenizer = ServerTokenizer(self._server, path)
        self.window = self._server.window
        """Size of the context window in tokens, as trained."""
        self._prompt = _NO_PROMPT

    def close(self) -> None:
        """Free the memory."""
        self._server.close()

    def read_prompt(self, prompt: Prompt, max_tokens: int) -> int:
        """Read a prompt and return how many of its tokens were cached from the previous one.

        Args:
            prompt: the prompt.
            max_tokens: tokens to reserve for the completion.
        """
        if self._server.reserve(len(prompt.tokens) + max_tokens, self.window):
            self._prompt = _NO_PROMPT
        kept = _kept_tokens(prompt, self._prompt)
        self._prompt = _NO_PROMPT
        if kept < len(prompt.shared):
            self._server.predict(prompt.shared, 1, is_cached=False)
        if kept < len(prompt.tokens):
            self._server.predict(prompt.shared, 1)
            self._server.predict(prompt.tokens, 1)
        self._server.predict(prompt.tokens, 1)
        self._prompt = prompt
        return kept

    def logits(self, generated: Sequence[int]) -> npt.NDArray[np.float32]:
        """Return the log-probabilities of the next token after the prompt and the generated tokens: (vocabulary,).

        Tokens beyond the most probable ones share the remaining probability equally.
        """
        found = self._server.predict([*self._prompt.tokens, *generated], LIMITS.likely_tokens)
        return spread_rest(found, self._server.vocabulary_size)


def spread_rest(found: Sequence[NextToken], size: int) -> npt.NDArray[np.float32]:
    """Return the log-probabilities of all tokens: those found, and equal ones for the others, (size,).

    Args:
        found: the most probable tokens, of which the last is the least probable.
        size: size of the vocabulary.
    """
    rest = max(1.0 - math.fsum(math.exp(row.logprob) for row in found), sys.float_info.min)
    share = min(found[-1].logprob, math.log(rest / max(1, size - len(found))))
    logprobs = np.full(size, share, np.float32)
    logprobs[[row.token for row in found]] = [row.logprob for row in found]
    return logprobs


def _kept_tokens(prompt: Prompt, previous: Prompt) -> int:
    """Return how many tokens the cache keeps of the previous prompt: all, its system prompt, or none."""
    if prompt == previous:
        return len(prompt.tokens)
    return len(prompt.shared) if prompt.shared == previous.shared else 0
