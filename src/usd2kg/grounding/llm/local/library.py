"""Import of llama-cpp-python, and a check of the weights file before loading."""

import logging
from pathlib import Path
from types import ModuleType

from usd2kg.errors import GroundingError

__all__ = ["check_weights", "import_llama_cpp"]

_MAGIC = b"GGUF"


def import_llama_cpp(model: str) -> ModuleType:
    """Return the module `llama_cpp`, with llama.cpp's log messages off.

    Raises:
        GroundingError: the extra `local` is not installed.
    """
    try:
        import llama_cpp  # noqa: PLC0415 - the extra may be missing
    except ImportError as error:
        raise GroundingError(
            f"model '{model}': the module {error.name} is not installed; "
            "expected the extra `local`, run pip install 'usd2kg[local]'"
        ) from error
    # The library prints llama.cpp's messages unless its logger has a level.
    if (logger := logging.getLogger("llama-cpp-python")).level == logging.NOTSET:
        logger.setLevel(logging.CRITICAL)
    module: ModuleType = llama_cpp
    return module


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
