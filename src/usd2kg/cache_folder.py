"""cache_folder: where files that only save time are kept."""

import os
import sys
from pathlib import Path

__all__ = ["cache_folder", "chosen_cache_folder"]


def cache_folder() -> Path:
    """Return the folder `usd2kg` in the user's cache folder; it may not exist yet.

    The user's cache folder is `%LOCALAPPDATA%` on Windows, elsewhere `$XDG_CACHE_HOME` or `~/.cache` (XDG Base
    Directory Specification 0.8, which ignores a relative `$XDG_CACHE_HOME`).

    Raises:
        RuntimeError: the home folder cannot be determined.
    """
    is_windows = sys.platform == "win32"
    folder = Path(os.environ.get("LOCALAPPDATA" if is_windows else "XDG_CACHE_HOME", ""))
    if not folder.is_absolute():
        folder = Path.home() / ("AppData/Local" if is_windows else ".cache")
    return folder / "usd2kg"


def chosen_cache_folder(variable: str, name: str) -> Path | None:
    """Return the folder of one cache: that of an environment variable, else `name` in `cache_folder`.

    Returns:
        None if the variable is `off`, or there is no home folder.
    """
    chosen = os.environ.get(variable, "")
    if chosen.lower() == "off":
        return None
    try:
        return Path(chosen) if chosen else cache_folder() / name
    except RuntimeError:
        return None
