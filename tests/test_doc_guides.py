"""The code blocks of the tutorial, the guides and the page for extensions run and print what the pages show."""

from pathlib import Path

import pytest

from tests.doc_console import run_page
from tests.doc_pages import GUIDES, ROOT

pytestmark = pytest.mark.docs


@pytest.mark.parametrize("page", GUIDES)
def test_the_code_blocks_run(page: str, tmp_path: Path) -> None:
    folder = tmp_path / "page"
    folder.mkdir()
    GUIDES[page](folder)
    run_page(ROOT / page, folder)
