"""What the documents say is what the software does."""

import subprocess
import sys
from pathlib import Path

import pytest

import usd2kg
from usd2kg.demo import demo_scene
from usd2kg.graph.vocabulary import U2K

ROOT = Path(__file__).parents[1]


def test_the_command_line_page_is_up_to_date() -> None:
    subprocess.run([sys.executable, "tools/write_cli_docs.py", "--check"], check=True, cwd=ROOT)


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_every_term_of_our_own_is_documented(profile: str) -> None:
    page = (ROOT / "docs/vocabulary.md").read_text("utf-8")
    graph = usd2kg.build(demo_scene(), profile=profile).graph
    terms = {
        term.value for triple in graph.triples for term in triple if getattr(term, "value", "").startswith(U2K.iri)
    }
    assert len(terms) >= 12
    assert not [iri for iri in terms if f"`u2k:{iri.removeprefix(U2K.iri)}`" not in page]


@pytest.mark.parametrize("command", ["make demo", "make test"])
def test_the_readme_shows_how_to_start(command: str) -> None:
    assert command in (ROOT / "README.md").read_text("utf-8")
