"""Import of the library that runs llama.cpp, and a check of the weights file before loading."""

import importlib
import logging
from pathlib import Path
from types import ModuleType

from usd2kg.errors import GroundingError

__all__ = ["LLAMA_CPP", "XLLAMACPP", "check_weights", "import_library"]

logger = logging.getLogger(__name__)

LLAMA_CPP = "llama_cpp"
"""Module of llama-cpp-python, compiled for this processor at its installation."""
XLLAMACPP = "xllamacpp"
"""Module with prebuilt wheels."""

_MAGIC = b"GGUF"


def import_library(model: str) -> ModuleType:
    """Return the module `llama_cpp` if it is installed, else `xllamacpp`.

    Raises:
        GroundingError: neither is installed.
    """
    module = _import(LLAMA_CPP) or _import(XLLAMACPP)
    if module is None:
        raise GroundingError(
            f"model '{model}': neither xllamacpp nor llama-cpp-python is installed; "
            "expected the extra `gguf` or `local`, run pip install 'usd2kg[gguf]'"
        )
    # llama-cpp-python prints llama.cpp's messages unless its logger has a level.
    if (messages := logging.getLogger("llama-cpp-python")).level == logging.NOTSET:
        messages.setLevel(logging.CRITICAL)
    return module


def _import(name: str) -> ModuleType | None:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        logger.debug("%s cannot be imported: %s", name, error)
        return None


def check_weights(path: Path) -> None:
    """Raise GroundingError unless the file exists and begins with the magic number of GGUF."""
    try:
        with path.open("rb") as file:
            start = file.read(len(_MAGIC))
    except OSError as error:
        raise GroundingError(
            f"{path}: the weights cannot be read ({error.strerror}); expected a GGUF file, check its name"
        ) from error
    if start != _MAGIC:
        raise GroundingError(
            f"{path}: is not a GGUF file, it begins with {start!r}; expected weights in the format of llama.cpp"
        )
