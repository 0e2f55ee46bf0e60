"""DictionaryGrounder: exact lookup, refusals and unreadable classes."""

from pathlib import Path

import pytest

from tests.grounding.records import SOMA, make_class, make_tbox
from usd2kg.errors import GroundingError
from usd2kg.grounding import Candidate, ObjectView, Prediction, Status
from usd2kg.grounding.baselines.dictionary import DictionaryGrounder
from usd2kg.ontology import TBox


def ask(grounder: DictionaryGrounder, name: str, tbox: TBox) -> Prediction:
    (prediction,) = grounder.ground_views([("/Room/thing", ObjectView(name=name))], tbox)
    return prediction


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def test_grounds_a_name_in_the_dictionary(home_tbox: TBox):
    prediction = ask(DictionaryGrounder.multiverse(), "spoon", home_tbox)
    assert prediction == Prediction(
        prim_path="/Room/thing",
        class_iri=SOMA + "Spoon",
        confidence=1.0,
        status=Status.GROUNDED,
        grounder="dictionary",
        explanation="“spoon” is in the dictionary as Spoon",
        evidence=("name",),
        candidates=(Candidate(SOMA + "Spoon", 1.0),),
    )


@pytest.mark.parametrize("name", ["Spoon", "spoon_1", "spoons", " spoon", ""])
def test_refuses_an_unknown_name(home_tbox: TBox, name: str):
    prediction = ask(DictionaryGrounder.multiverse(), name, home_tbox)
    assert (prediction.status, prediction.class_iri, prediction.confidence) == (Status.REFUSED, None, None)
    assert f"“{name}” is not in the dictionary" in prediction.explanation


def test_a_class_outside_the_tbox_is_unreadable(home_tbox: TBox):
    prediction = ask(DictionaryGrounder({"cat": "Cat"}, "mine"), "cat", home_tbox)
    assert (prediction.status, prediction.class_iri, prediction.candidates) == (Status.UNREADABLE, None, ())
    assert "Cat" in prediction.explanation


def test_an_ambiguous_local_name_is_unreadable():
    tbox = make_tbox(make_class("Cup"), make_class("Cup", base=SOMA))
    assert ask(DictionaryGrounder({"cup": "Cup"}, "mine"), "cup", tbox).status is Status.UNREADABLE
    assert ask(DictionaryGrounder({"cup": SOMA + "Cup"}, "mine"), "cup", tbox).class_iri == SOMA + "Cup"


@pytest.mark.parametrize("written", ["Cup", "soma:Cup", SOMA + "Cup", f"<{SOMA}Cup>"])
def test_accepts_local_names_curies_and_iris(home_tbox: TBox, tmp_path: Path, written: str):
    table = write(tmp_path / "names.csv", f"name,class\nteacup,{written}\n")
    assert ask(DictionaryGrounder.from_csv(table), "teacup", home_tbox).class_iri == SOMA + "Cup"


def test_ignores_other_columns(home_tbox: TBox, tmp_path: Path):
    table = write(tmp_path / "names.csv", '\ufeffnote,class,name\n"old, chipped",Cup,teacup\n,Bowl,"big, blue"\n')
    grounder = DictionaryGrounder.from_csv(table)
    assert ask(grounder, "teacup", home_tbox).class_iri == SOMA + "Cup"
    assert ask(grounder, "big, blue", home_tbox).class_iri == SOMA + "Bowl"


def test_ignores_rows_without_name_or_class(home_tbox: TBox, tmp_path: Path):
    table = write(tmp_path / "names.csv", "name,class\nteacup\n,Cup\nmug,\nbowl,Bowl\n")
    grounder = DictionaryGrounder.from_csv(table)
    statuses = [ask(grounder, name, home_tbox).status for name in ("teacup", "", "mug", "bowl")]
    assert statuses == [Status.REFUSED, Status.REFUSED, Status.REFUSED, Status.GROUNDED]


def test_settings_contain_the_table(tmp_path: Path):
    table = write(tmp_path / "names.csv", "name,class\n")
    assert DictionaryGrounder.from_csv(table).settings == {"dictionary": str(table)}
    assert DictionaryGrounder.multiverse().settings == {"dictionary": "multiverse"}


@pytest.mark.parametrize(
    ("text", "found"),
    [("", "nothing"), ("prim,iri\na,b\n", "prim, iri"), ("name;class\ncup;Cup\n", "name;class")],
)
def test_rejects_a_table_with_other_columns(tmp_path: Path, text: str, found: str):
    table = write(tmp_path / "names.csv", text)
    with pytest.raises(GroundingError) as error:
        DictionaryGrounder.from_csv(table)
    assert str(table) in str(error.value)
    assert found in str(error.value)
    assert "expected name,class" in str(error.value)


def test_reports_an_unreadable_table(tmp_path: Path):
    with pytest.raises(GroundingError, match="cannot be read as a CSV file"):
        DictionaryGrounder.from_csv(tmp_path / "none.csv")
    binary = tmp_path / "names.csv"
    binary.write_bytes(b"name,class\n\xff\xfe,Cup\n")
    with pytest.raises(GroundingError, match="cannot be read as a CSV file"):
        DictionaryGrounder.from_csv(binary)


def test_reports_an_unclosed_quote(tmp_path: Path):
    # The rest of the file is one field, longer than the csv module allows (131,072 characters).
    table = write(tmp_path / "names.csv", 'name,class\n"cup,Cup\n' + "mug,Cup\n" * 20_000)
    with pytest.raises(GroundingError, match=r"names\.csv"):
        DictionaryGrounder.from_csv(table)
