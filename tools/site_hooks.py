"""Hooks of mkdocs.yml: pages and files of the repository outside docs become pages and files of the site.

Documents link to each other by their paths in the repository, as Git hosting shows them. The site has the documents of
docs/ at its root and the others below repository/; links between the two are rewritten.
"""

import posixpath
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mkdocs.structure.files import File, Files

OUTSIDE = "repository/"
"""Folder of the site for what is outside docs."""
SEEDS = (
    "README.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "CHANGELOG.md",
    "benchmarks/README.md",
    "examples/README.md",
    "knowledge/README.md",
    "scenes/README.md",
)
"""Documents outside docs that are in the navigation."""
_FENCE = re.compile(r"^( *```.*?^ *```$)", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(?<=\]\()(?![a-z]+:|#|/)([^)\s#]+)(?=[)\s#])")


def on_files(files: Files, config: Any) -> Files:
    """Add the seeds, and all files outside docs that a document links to."""
    root = _root(config)
    waiting = [*SEEDS, *(f"docs/{file.src_uri}" for file in files.documentation_pages())]
    seen = set(waiting)
    while waiting:
        path = waiting.pop()
        if not path.startswith("docs/"):
            source = str(root / path)
            files.append(File.generated(config, OUTSIDE + path, abs_src_path=source))
        if path.endswith(".md"):
            found = {target for target in _targets(root, path) if target not in seen and not target.startswith("docs/")}
            seen |= found
            waiting += sorted(found)
    return files


def on_page_markdown(markdown: str, page: Any, config: Any, files: Files) -> str:
    """Return a document with links by paths of the site instead of the repository."""
    path = _repository_path(page.file.src_uri)
    start = posixpath.dirname(page.file.src_uri)

    def rewrite(match: re.Match[str]) -> str:
        target = _resolve(_root(config), path, match[1])
        return match[1] if target is None else posixpath.relpath(_site_path(target), start or ".")

    # Every other part is a code block.
    parts = _FENCE.split(markdown)
    return "".join(part if index % 2 else _LINK.sub(rewrite, part) for index, part in enumerate(parts))


def _targets(root: Path, path: str) -> Iterator[str]:
    for part in _FENCE.split((root / path).read_text("utf-8"))[::2]:
        for link in _LINK.findall(part):
            if (target := _resolve(root, path, link)) is not None:
                yield target


def _resolve(root: Path, path: str, link: str) -> str | None:
    """Return the path in the repository of what a document links to, the README of a folder; None if it is missing."""
    target = posixpath.normpath(posixpath.join(posixpath.dirname(path), link))
    if (root / target).is_dir():
        target = posixpath.join(target, "README.md")
    return target if (root / target).is_file() else None


def _repository_path(site_path: str) -> str:
    return site_path.removeprefix(OUTSIDE) if site_path.startswith(OUTSIDE) else f"docs/{site_path}"


def _site_path(path: str) -> str:
    return path.removeprefix("docs/") if path.startswith("docs/") else OUTSIDE + path


def _root(config: Any) -> Path:
    return Path(config.config_file_path).parent
