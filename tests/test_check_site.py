"""The check of the built documentation: links inside it, and nothing loaded from elsewhere."""

from pathlib import Path

import pytest

from tools.check_site import check_site

PAGE = '<!doctype html><html><body><h2 id="here">A</h2><a href="#here">a</a>{}</body></html>'


def problems(folder: Path, body: str) -> list[str]:
    (folder / "index.html").write_text(PAGE.format(body), "utf-8")
    return check_site(folder.resolve()).broken


def test_counts_pages_links_and_external_links(tmp_path: Path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/page.html").write_text(PAGE.format('<a href="../index.html#here">b</a>'), "utf-8")
    (tmp_path / "index.html").write_text(PAGE.format('<a href="https://example.org/x?y=1#z">c</a>'), "utf-8")
    assert check_site(tmp_path.resolve()) == (2, 4, 1, [])


@pytest.mark.parametrize(
    "body",
    [
        '<a href="sub/">folder</a>',
        '<a href="/">root</a>',
        '<a href="sub/index.html#%C3%BC">umlaut</a>',
        '<img src="sub/a.png">',
        '<a href="mailto:someone@example.org">mail</a>',
        '<img src="data:image/png;base64,AAAA">',
    ],
)
def test_accepts_links_to_what_exists(tmp_path: Path, body: str):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/index.html").write_text('<h2 id="ü">A</h2>', "utf-8")
    (tmp_path / "sub/a.png").write_bytes(b"")
    assert problems(tmp_path, body) == []


@pytest.mark.parametrize(
    ("body", "problem"),
    [
        ('<a href="gone.html">a</a>', "'gone.html' is not in the site"),
        ('<a href="#gone">a</a>', "'#gone' has no such anchor"),
        ('<a href="../outside.html">a</a>', "'../outside.html' is not in the site"),
        ('<img src="gone.png">', "'gone.png' is not in the site"),
        ('<script src="https://example.org/a.js"></script>', "'https://example.org/a.js' is loaded from another host"),
        ('<link rel="stylesheet" href="//example.org/a.css">', "'//example.org/a.css' is loaded from another host"),
        ('<a href="htps://example.org">a</a>', "'htps://example.org' has the scheme 'htps'; expected one of http"),
        ('<a href="https://exa mple.org">a</a>', "'https://exa mple.org' has the host 'exa mple.org'"),
        ('<pre class="mermaid">graph</pre>', "has a mermaid diagram"),
    ],
)
def test_reports_what_is_broken(tmp_path: Path, body: str, problem: str):
    (tmp_path.parent / "outside.html").write_text("", "utf-8")
    (found,) = problems(tmp_path, body)
    assert found.startswith(f"index.html: {problem}")


def test_reports_styles_from_another_host(tmp_path: Path):
    (tmp_path / "a.css").write_text("@import url('https://fonts.example.org/a.css');", "utf-8")
    (found,) = problems(tmp_path, "")
    assert found.startswith("a.css: ") and found.endswith("is loaded from another host")
