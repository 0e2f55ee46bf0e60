"""Files of the built web pages (see `web/`) by URL path."""

from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import NamedTuple

from usd2kg.errors import OutputError

__all__ = ["AppFile", "read_app_files"]

_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self' blob:; "
    "font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""Content-Security-Policy of the page: same-origin files only."""

_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".woff2": "font/woff2",
    ".png": "image/png",
}


_HASHED = "/assets/"
"""Path prefix of files with a content hash in their names."""


class AppFile(NamedTuple):
    """One file of the page."""

    content: bytes
    media_type: str

    def headers(self, path: str) -> dict[str, str]:
        """Return the headers of the response at a URL path."""
        # A browser keeps compiled code with the cached file, so that the page starts faster the next time.
        kept = {"Cache-Control": "private, max-age=31536000, immutable"} if path.startswith(_HASHED) else {}
        return {"Content-Security-Policy": _POLICY, **kept}


def read_app_files(page: str) -> dict[str, AppFile]:
    """Return URL path → file of a page, which is at `/`. No other files are served.

    Args:
        page: `index.html`, the studio, or `query.html`, the query page of the endpoint.

    Raises:
        OutputError: the pages are not built.
    """
    folder = files("usd2kg.endpoint") / "app"
    if not (folder / page).is_file():
        raise OutputError(f"the page {page} is not built; install usd2kg from a wheel, or run make web (needs Node.js)")
    found = {f"/{path}": file for path, file in _walk(folder, "") if not path.endswith(".html") or path == page}
    return {"/": found[f"/{page}"], **found}


def _walk(folder: Traversable, prefix: str) -> list[tuple[str, AppFile]]:
    found: list[tuple[str, AppFile]] = []
    for entry in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if entry.is_dir():
            found += _walk(entry, f"{prefix}{entry.name}/")
        elif (media_type := _TYPES.get("." + entry.name.rpartition(".")[2])) is not None:
            found.append((f"{prefix}{entry.name}", AppFile(entry.read_bytes(), media_type)))
    return found
