"""The documents agree with the software."""

import re
from importlib import import_module

import pytest

import usd2kg
from tests.doc_console import read_blocks
from tests.doc_counts import count_blocks
from tests.doc_pages import GENERATED, ROOT, all_pages


@pytest.mark.parametrize("page", ["cli", "questions", "vocabulary"])
def test_generated_pages_are_up_to_date(page: str) -> None:
    written = import_module(f"tools.write_{page}_docs").build_page()
    assert (ROOT / f"docs/{page}.md").read_text("utf-8") == written, f"run python -m tools.write_{page}_docs"


@pytest.mark.parametrize("command", ["make demo", "make test"])
def test_readme_shows_how_to_start(command: str) -> None:
    assert command in (ROOT / "README.md").read_text("utf-8")


def test_every_code_block_is_run_or_says_why_not() -> None:
    counts = count_blocks()
    assert not counts.left, f"{counts}; neither: {', '.join(counts.left)}"
    unread = [
        f"{page}:{block.line}" for page in all_pages() for block in read_blocks(ROOT / page) if not block.language
    ]
    assert not unread, f"blocks without a language: {', '.join(unread)}"


def test_the_api_page_lists_the_public_names() -> None:
    page = (ROOT / "docs/api.md").read_text("utf-8")
    listed = re.findall(r"^::: ([\w.]+)\n    options:\n      heading: usd2kg\.(\w+)$", page, re.MULTILINE)
    assert sorted(heading for _, heading in listed) == sorted([*usd2kg.__all__, "open"])
    for path, heading in listed:
        found = getattr(usd2kg, heading)
        assert path == f"{found.__module__}.{found.__qualname__}"


@pytest.mark.parametrize("page", [page for page in all_pages() if page not in GENERATED])
def test_links_work_on_git_hosting(page: str) -> None:
    text = re.sub(r"^ *```.*?^ *```$", "", (ROOT / page).read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)
    for target in re.findall(r"\]\((?![a-z]+:|#)([^)\s#]+)", text):
        assert (ROOT / page).parent.joinpath(target).exists(), target
