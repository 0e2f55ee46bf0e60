"""Check the links of a built site: targets and anchors inside it exist, and no page loads anything from another host.

Usage: python tools/check_site.py FOLDER

External links are only checked for syntax; nothing is fetched. Prints the numbers of pages, links and broken links, and
exits with 1 if a link is broken.
"""

import re
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

_RESOURCES = frozenset(
    {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("use", "href")}
)
"""Tags and attributes whose target a browser loads with the page."""
_SCHEMES = frozenset({"http", "https", "mailto"})
_HOST = re.compile(r"(?:[a-z0-9](?:[a-z0-9-]*[a-z0-9])?\.)*[a-z0-9](?:[a-z0-9-]*[a-z0-9])?(?::\d+)?", re.IGNORECASE)
_CSS_LOAD = re.compile(r"""(?:@import\s+|url\()\s*["']?\s*(https?:)?//[^"')\s]+""")


class Link(NamedTuple):
    """A link of a page."""

    target: str
    is_resource: bool
    """Whether a browser loads it with the page."""


class Page(HTMLParser):
    """The anchors and links of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[Link] = []
        self.has_mermaid = False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note the anchors and links of a tag."""
        for name, value in attrs:
            if name == "class" and "mermaid" in (value or "").split():
                self.has_mermaid = True
            elif name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value or "")
            elif name == "href" or (tag, name) in _RESOURCES:
                self.links.append(Link(value or "", (tag, name) in _RESOURCES))


class Report(NamedTuple):
    """The result of a check."""

    pages: int
    links: int
    external: int
    """How many of the links lead to other hosts."""
    broken: list[str]
    """One sentence for each broken link, with its page."""


def check_site(folder: Path) -> Report:
    """Return what is wrong with the links of a built site."""
    pages = {path: Page(path.read_text("utf-8")) for path in sorted(folder.rglob("*.html"))}
    links = [(path, link) for path, page in pages.items() for link in page.links]
    broken = [
        f"{path.relative_to(folder).as_posix()}: {link.target!r} {problem}"
        for path, link in links
        if (problem := _problem(folder, path, link, pages))
    ]
    external = sum(_is_external(link.target) for _, link in links)
    broken += [
        f"{path.relative_to(folder).as_posix()}: has a mermaid diagram, whose script comes from another host"
        for path, page in pages.items()
        if page.has_mermaid
    ]
    return Report(len(pages), len(links), external, [*broken, *_style_problems(folder)])


def _problem(folder: Path, path: Path, link: Link, pages: dict[Path, Page]) -> str:
    """Return what is wrong with a link, empty if nothing is."""
    if link.target.startswith("data:"):
        return ""
    if _is_external(link.target):
        return "is loaded from another host" if link.is_resource else _syntax_problem(link.target)
    parts = urlsplit(link.target)
    # A page of errors is served at any address, so its links start at the root.
    start = folder if parts.path.startswith("/") else path.parent
    target = (start / unquote(parts.path).lstrip("/")).resolve() if parts.path else path
    if target.is_dir():
        target /= "index.html"
    if not target.is_file() or not target.is_relative_to(folder.resolve()):
        return "is not in the site"
    anchor = unquote(parts.fragment)
    if anchor and target in pages and anchor not in pages[target].anchors:
        return "has no such anchor"
    return ""


def _is_external(target: str) -> bool:
    return target.startswith("//") or urlsplit(target).scheme not in {"", "data"}


def _syntax_problem(target: str) -> str:
    parts = urlsplit(target)
    if parts.scheme not in _SCHEMES:
        return f"has the scheme {parts.scheme!r}; expected one of {', '.join(sorted(_SCHEMES))}"
    if parts.scheme != "mailto" and not _HOST.fullmatch(parts.netloc):
        return f"has the host {parts.netloc!r}"
    return "contains a space" if " " in target else ""


def _style_problems(folder: Path) -> Iterator[str]:
    for path in sorted(folder.rglob("*.css")):
        if found := _CSS_LOAD.search(path.read_text("utf-8")):
            yield f"{path.relative_to(folder).as_posix()}: {found[0]!r} is loaded from another host"


def main() -> None:
    """Check the site that the command line names."""
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        raise SystemExit("usage: python tools/check_site.py FOLDER, a folder that make docs wrote")
    report = check_site(Path(sys.argv[1]).resolve())
    for sentence in report.broken:
        print(sentence, file=sys.stderr)
    print(f"{report.pages} pages, {report.links} links ({report.external} external), {len(report.broken)} broken")
    raise SystemExit(1 if report.broken else 0)


if __name__ == "__main__":
    main()
