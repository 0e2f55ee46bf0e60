"""LocalClient: a model in this process, from the model string `gguf:FILE`."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from threading import Lock
from types import TracebackType
from typing import Protocol, Self

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Completion, Request, Usage
from usd2kg.grounding.llm.local.decoding import DecodingPlan, TextTokenizer, TokenModel, decode_answer
from usd2kg.grounding.llm.local.json_tokens import JsonStringTokens, classify_tokens
from usd2kg.grounding.llm.local.library import LLAMA_CPP, check_weights, import_library
from usd2kg.grounding.llm.local.llama import LlamaModel
from usd2kg.grounding.llm.local.server_model import ServerModel
from usd2kg.grounding.llm.local.skeleton import read_schema
from usd2kg.grounding.llm.local.tokenizer import Prompt

__all__ = ["ChatTokenizer", "LocalClient", "LocalModel", "is_local_model", "open_local"]

_SCHEME = "gguf:"


class ChatTokenizer(TextTokenizer, Protocol):
    """A tokenizer with a chat template."""

    @property
    def ends(self) -> frozenset[int]:
        """The end-of-generation tokens."""
        ...

    def encode_prompt(self, system: str, user: str) -> Prompt:
        """Return system and user prompt in the chat template."""
        ...


class LocalModel(TokenModel, Protocol):
    """A loaded model."""

    @property
    def window(self) -> int:
        """Size of the context window in tokens."""
        ...

    @property
    def tokenizer(self) -> ChatTokenizer:
        """Its tokenizer."""
        ...

    def read_prompt(self, prompt: Prompt, max_tokens: int) -> int:
        """Read a prompt, reserve space for `max_tokens` more, and return the number of cached prompt tokens."""
        ...

    def close(self) -> None:
        """Free the memory."""
        ...


def is_local_model(model: str) -> bool:
    """Return whether a model string names a weights file."""
    return model.startswith(_SCHEME)


def open_local(model: str, *, threads: int = 1) -> "LocalClient":
    """Return a client for `gguf:FILE`, which loads the weights at the first request.

    Args:
        model: the model string; a leading `~` of the path is the user's home folder.
        threads: number of CPU threads.

    Raises:
        GroundingError: neither the extra `gguf` nor `local` is installed, or the file is missing or not GGUF.
    """
    library = import_library(model)
    path = Path(model.removeprefix(_SCHEME)).expanduser()
    check_weights(path)
    load: Callable[..., LocalModel] = LlamaModel if library.__name__ == LLAMA_CPP else ServerModel
    return LocalClient(model, partial(load, library, path, threads))


class LocalClient:
    """One model in this process. Thread-safe; it serves one request at a time.

    Answers always conform to the schema. The system prompt stays in the model's cache between requests.
    """

    def __init__(self, model: str, load: Callable[[], LocalModel]) -> None:
        """Create a client for the model that `load` returns."""
        self.model = model
        self._load = load
        self._loaded: tuple[LocalModel, JsonStringTokens] | None = None
        self._lock = Lock()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Free the weights. The next request loads them again."""
        with self._lock:
            if self._loaded is not None:
                self._loaded[0].close()
            self._loaded = None

    def complete(self, request: Request) -> Completion:
        """Return the model's completion. It conforms to the schema, but rows beyond the token limit are omitted.

        Raises:
            GroundingError: the weights cannot be loaded, the prompt does not fit the context window, or the request
                asks for thinking.
        """
        if request.is_thinking:
            raise GroundingError(
                f"model '{self.model}': models in this process do not think before they answer; "
                "leave out --thinking, or have the reasoning in the answer with llm-C"
            )
        with self._lock:
            return self._answer(request)

    def _answer(self, request: Request) -> Completion:
        if self._loaded is None:
            model = self._load()
            self._loaded = model, classify_tokens(model.tokenizer.pieces, model.tokenizer.ends)
        model, string_tokens = self._loaded
        plan = DecodingPlan(read_schema(request.schema), model.tokenizer)
        prompt = model.tokenizer.encode_prompt(request.system, request.user)
        max_tokens = min(request.max_tokens, plan.max_answer_tokens, self._remaining_tokens(prompt, plan, model.window))
        cached = model.read_prompt(prompt, max_tokens)
        decoded = decode_answer(
            plan, model, string_tokens, max_tokens=max_tokens, temperature=request.temperature, seed=request.sample
        )
        usage = Usage(len(prompt.tokens), cached, len(decoded.tokens))
        return Completion(decoded.text, decoded.finish, usage, tokens=decoded.tokens)

    def _remaining_tokens(self, prompt: Prompt, plan: DecodingPlan, window: int) -> int:
        """Return how many tokens fit the context window after a prompt."""
        size, remaining = len(prompt.tokens), window - len(prompt.tokens)
        if remaining < plan.min_answer_tokens:
            raise GroundingError(
                f"model '{self.model}': the prompt has {size} tokens and its answer {plan.min_answer_tokens} or more, "
                f"but the model reads {window} at most; offer fewer classes with --shortlist, or ask about fewer "
                "objects a prompt with --objects-per-prompt"
            )
        return remaining
