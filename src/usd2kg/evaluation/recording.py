"""The recording of a matrix: the completions behind its results, for replay without API keys."""

import logging
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usd2kg.grounding.llm.factory import LLMSettings

__all__ = ["RECORDING", "restore_recording", "write_recording"]

logger = logging.getLogger(__name__)

RECORDING = "recording.jsonl.gz"
"""File name in the folder of the results."""


def restore_recording(folder: Path, settings: "LLMSettings | None") -> None:
    """Add the completions of the recording in a folder, if there is one, to the cache.

    Raises:
        GroundingError: the recording or the cache cannot be read.
    """
    from usd2kg.grounding.llm.cache import CompletionCache  # noqa: PLC0415 - slow to import

    recording = folder / RECORDING
    if recording.exists():
        with CompletionCache(_cache_path(settings)) as cache:
            added = cache.import_recording(recording)
        logger.info("%s: %d completions that were not in the cache", recording, added)


def write_recording(folder: Path, settings: "LLMSettings | None", keys: Iterable[str]) -> None:
    """Write the completions with these cache keys as the recording in a folder.

    Raises:
        GroundingError: the cache cannot be read.
        OutputError: the recording cannot be written.
    """
    from usd2kg.grounding.llm.cache import CompletionCache  # noqa: PLC0415

    wanted = frozenset(keys)
    with CompletionCache(_cache_path(settings)) as cache:
        written = cache.export_recording(folder / RECORDING, wanted)
    if written < len(wanted):
        logger.warning(
            "%s lacks %d of %d completions, which are no longer in the cache; request them with --refresh",
            folder / RECORDING,
            len(wanted) - written,
            len(wanted),
        )


def _cache_path(settings: "LLMSettings | None") -> Path:
    from usd2kg.grounding.llm.cache import default_cache_path  # noqa: PLC0415

    return (settings.completions if settings is not None else None) or default_cache_path()
