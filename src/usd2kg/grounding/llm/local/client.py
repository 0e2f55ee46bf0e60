"""The client of a model in this process, by the name `gguf:FILE`."""

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
from usd2kg.grounding.llm.local.library import check_weights, import_llama_cpp
from usd2kg.grounding.llm.local.llama import LlamaModel
from usd2kg.grounding.llm.local.skeleton import read_schema
from usd2kg.grounding.llm.local.tokenizer import Prompt

__all__ = ["ChatTokenizer", "LocalClient", "LocalModel", "is_local_model", "open_local"]

_SCHEME = "gguf:"


class ChatTokenizer(TextTokenizer, Protocol):
    """A vocabulary with a chat template."""

    @property
    def ends(self) -> frozenset[int]:
        """The tokens by which the model says that it is done."""
        ...

    def frame(self, system: str, user: str) -> Prompt:
        """Return instructions and question inside the template."""
        ...


class LocalModel(TokenModel, Protocol):
    """A model in memory."""

    @property
    def window(self) -> int:
        """TextTokenizer that it can read at once."""
        ...

    @property
    def tokenizer(self) -> ChatTokenizer:
        """Its vocabulary."""
        ...

    def begin(self, prompt: Prompt, room: int) -> int:
        """Read a prompt with room for so many tokens behind it; return how many were still there from the last one."""
        ...

    def close(self) -> None:
        """Free the memory."""
        ...


def is_local_model(model: str) -> bool:
    """Return whether a model string names a file of weights."""
    return model.startswith(_SCHEME)


def open_local(model: str, *, threads: int = 1) -> "LocalClient":
    """Return a client for `gguf:FILE`; the weights are loaded when it is asked first.

    Args:
        model: the model string; a `~` at the beginning of the path is the user's home folder.
        threads: processor threads that compute.

    Raises:
        GroundingError: the extra `local` is not installed, or the file is missing or no GGUF.
    """
    library = import_llama_cpp(model)
    path = Path(model.removeprefix(_SCHEME)).expanduser()
    check_weights(path)
    return LocalClient(model, partial(LlamaModel, library, path, threads))


class LocalClient:
    """One model in this process, to be used from any number of threads: it serves one request at a time.

    Answers fit the schema always. Its system part is kept from one request to the next.
    """

    def __init__(self, model: str, load: Callable[[], LocalModel]) -> None:
        """Make the client of a model that `load` loads."""
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
        """Free the weights; the next request would load them again."""
        with self._lock:
            if self._loaded is not None:
                self._loaded[0].close()
            self._loaded = None

    def complete(self, request: Request) -> Completion:
        """Return the model's completion, JSON by the schema always; without room for all rows, the rest is left out.

        Raises:
            GroundingError: the weights cannot be loaded, the prompt leaves no room in the context window, or the
                request asks for reasoning before the answer.
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
        model, vocabulary = self._loaded
        plan = DecodingPlan(read_schema(request.schema), model.tokenizer)
        prompt = model.tokenizer.frame(request.system, request.user)
        room = min(request.max_tokens, plan.max_answer_tokens, self._check_room(prompt, plan, model.window))
        cached = model.begin(prompt, room)
        written = decode_answer(
            plan, model, vocabulary, room=room, temperature=request.temperature, seed=request.sample
        )
        usage = Usage(len(prompt.tokens), cached, len(written.tokens))
        return Completion(written.text, written.finish, usage, tokens=written.tokens)

    def _check_room(self, prompt: Prompt, plan: DecodingPlan, window: int) -> int:
        """Return how many tokens may follow a prompt."""
        size, room = len(prompt.tokens), window - len(prompt.tokens)
        if room < plan.min_answer_tokens:
            raise GroundingError(
                f"model '{self.model}': the prompt has {size} tokens and its answer {plan.min_answer_tokens} or more, "
                f"but the model reads {window} at most; offer fewer classes with --shortlist, or ask about fewer "
                "objects a prompt with --objects-per-prompt"
            )
        return room
