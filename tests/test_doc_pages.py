"""The code blocks of the README and of the pages in docs run and print what the pages show."""

from pathlib import Path

import pytest

from tests.doc_console import matches, read_blocks, run_page
from tests.doc_pages import PAGES, ROOT
from usd2kg.evaluation import read_matrix
from usd2kg.relations import load_rules
from usd2kg.validation import read_rules

pytestmark = pytest.mark.docs


@pytest.mark.parametrize("page", PAGES)
def test_the_code_blocks_run(page: str, tmp_path: Path) -> None:
    folder = tmp_path / "page"
    folder.mkdir()
    PAGES[page](folder)
    run_page(ROOT / page, folder)
    if check := _CHECKS.get(page):
        check(folder)


def _check_label_layer(folder: Path) -> None:
    (block,) = [block for block in read_blocks(ROOT / "docs/labels.md", "text") if block.text.startswith("#usda")]
    assert matches(block.text.splitlines(), (folder / "house.labels.usda").read_text("utf-8").rstrip().splitlines())


def _check_messages(folder: Path) -> None:
    page = ROOT / "docs/robots.md"
    for language, file in (("yaml", "tf/tf_static.yaml"), ("json", "ros2/relations.json")):
        (shown,) = read_blocks(page, language)
        printed = [line.strip(" ,") for line in (folder / file).read_text("utf-8").splitlines()]
        lines = [line.strip() for line in shown.text.splitlines()]
        assert any(printed[at : at + len(lines)] == lines for at in range(len(printed)))


_CHECKS = {
    "docs/evaluation.md": lambda folder: read_matrix(folder / "matrix.toml"),
    "docs/labels.md": _check_label_layer,
    "docs/relations.md": lambda folder: load_rules(folder / "my_rules.toml"),
    "docs/robots.md": _check_messages,
    "docs/validation.md": lambda folder: read_rules(folder / "rules.toml"),
}
"""Page → what else must hold after its blocks have run."""
