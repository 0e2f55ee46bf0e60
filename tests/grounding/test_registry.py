"""make_grounder: grounders by name."""

from pathlib import Path

import pytest

from usd2kg.errors import GroundingError
from usd2kg.grounding import is_llm_name, make_grounder


@pytest.mark.parametrize("name", ["lexical", "dictionary", "volume"])
def test_returns_the_grounder_called_by_the_name(name: str):
    assert make_grounder(name).name == name


def test_passes_the_dictionary_to_the_grounder(tmp_path: Path):
    table = tmp_path / "names.csv"
    table.write_text("name,class\n", encoding="utf-8")
    assert make_grounder("dictionary").settings == {"dictionary": "multiverse"}
    assert make_grounder("dictionary", dictionary=table).settings == {"dictionary": str(table)}


@pytest.mark.parametrize("name", ["", "Lexical", "llm"])
def test_rejects_an_unknown_name(name: str):
    with pytest.raises(GroundingError, match="expected one of lexical, dictionary"):
        make_grounder(name)


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("volume", {"dictionary": Path("names.csv")}, "takes no dictionary; choose the grounder dictionary"),
        ("lexical", {"class_sizes": Path("sizes.csv")}, "takes no class sizes; choose the grounder volume"),
        ("volume", {"abstains": True}, "cannot abstain; choose the grounder lexical"),
    ],
)
def test_rejects_an_option_of_another_grounder(name: str, options: dict[str, object], message: str):
    with pytest.raises(GroundingError, match=message):
        make_grounder(name, **options)


def test_recognises_names_of_language_models():
    assert is_llm_name("llm-B:google:g") and is_llm_name("llm:gguf:m.gguf")
    assert not is_llm_name("lexical") and not is_llm_name("llm")
