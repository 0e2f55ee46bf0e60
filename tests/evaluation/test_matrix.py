"""Run matrices: reading, running, and resuming from stored answers."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from tests.grounding.llm.servers import openai_reply, serve
from usd2kg.errors import EvaluationError, GroundingError
from usd2kg.evaluation import read_matrix, run_matrix
from usd2kg.evaluation.matrix import OWN_ABLATION, STUDY_ABLATION
from usd2kg.grounding import NamingRegime
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.llm.factory import LLMSettings
from usd2kg.ontology import load_places_tbox

SCENE = """
def Xform "World" {
  def Xform "Chair_1" (kind = "component")
  {
    def Cube "a" {}
  }
  def Xform "Table_1" (kind = "component")
  {
    def Cube "a" {}
  }
}
"""


@pytest.fixture
def matrix(tmp_path: Path, write_stage: Callable[..., Path]) -> Path:
    write_stage(SCENE)
    (tmp_path / "gold.csv").write_text("path,class\n/World/Chair_1,DesignedChair\n/World/Table_1,Table\n")
    path = tmp_path / "matrix.toml"
    path.write_text(
        'title = "two things"\ngrounders = ["lexical"]\nregimes = ["semantic", "opaque"]\nrepeats = 2\n'
        '[[scene]]\nname = "room"\npath = "scene.usda"\ngold = "gold.csv"\n'
        '[[scene]]\nname = "elsewhere"\npath = "none.usda"\ngold = "none.csv"\noptional = true\n'
    )
    return path


def test_cells_are_the_product_of_conditions_and_repeats_of_language_models(matrix: Path) -> None:
    matrix.write_text(matrix.read_text().replace('["lexical"]', '["lexical", "llm-A:openai:m"]'))
    cells = [cell for cell in read_matrix(matrix).cells() if cell.scene.name == "room"]
    assert [(c.grounder, c.condition, c.repeat) for c in cells] == [
        ("lexical", "semantic", 1),
        ("lexical", "opaque", 1),
        ("llm-A:openai:m", "semantic", 1),
        ("llm-A:openai:m", "semantic", 2),
        ("llm-A:openai:m", "opaque", 1),
        ("llm-A:openai:m", "opaque", 2),
    ]


def test_a_repeat_draws_samples_of_its_own(matrix: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", "sk-x")
    settings = LLMSettings("", completions=tmp_path / "said.sqlite", temperature=0.7)
    said = [openai_reply(json.dumps({"1": {"class": name}})) for name in ("Table", "Table", "DesignedChair", "Table")]
    with serve(*said) as server:
        name = f"llm-A:openai:m@{server.url}/v1"
        text = matrix.read_text().replace('["lexical"]', f'["{name}"]').replace(', "opaque"]', "]")
        matrix.write_text(text)
        plan = read_matrix(matrix)
        (result,) = run_matrix(plan, tmp_path / "out", settings=replace(settings, concurrency=1))
        (again,) = run_matrix(plan, tmp_path / "out", settings=settings)
        asked = [request.body["seed"] for request in server.received]
    assert asked == [0, 0, 1, 1]
    assert [cell.evaluation.summary.ema for cell in result.cells] == [50.0, 100.0]
    assert all(cell.was_stored for cell in again.cells)
    assert [cell.evaluation.scores for cell in again.cells] == [cell.evaluation.scores for cell in result.cells]


def test_rejects_repeats_at_temperature_0(matrix: Path, tmp_path: Path) -> None:
    matrix.write_text(matrix.read_text().replace('["lexical"]', '["llm-A:openai:m@http://localhost:1/v1"]'))
    settings = LLMSettings("", completions=tmp_path / "said.sqlite")
    with pytest.raises(GroundingError) as caught:
        run_matrix(read_matrix(matrix), tmp_path / "out", settings=settings)
    assert str(caught.value) == (
        "repeat 2 of openai:m@http://localhost:1/v1 at temperature 0 has the answers of the first; expected a "
        "--temperature above 0, or one repeat"
    )


def test_paths_may_be_text(matrix: Path, tmp_path: Path) -> None:
    plan = read_matrix(str(matrix))
    assert plan == read_matrix(matrix)
    run_matrix(plan, str(tmp_path / "out"))
    assert list((tmp_path / "out/runs").iterdir())


def test_ablation_adds_the_studys_conditions_and_ours(matrix: Path) -> None:
    matrix.write_text(matrix.read_text().replace("repeats = 2", "ablation = true"))
    cells = [cell for cell in read_matrix(matrix).cells() if cell.scene.name == "room"]
    assert [c.condition for c in cells][2:] == [*STUDY_ABLATION, *OWN_ABLATION]
    by_name = {c.condition: c for c in cells}
    assert len(STUDY_ABLATION) == 6
    assert by_name["geometry only"].regime is NamingRegime.OPAQUE
    assert by_name["geometry only"].evidence == {"geometry"}
    assert by_name["hierarchy only, anonymised"].regime is NamingRegime.OPAQUE_ANONYMOUS


def test_reuses_stored_answers_unless_refreshed(matrix: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []
    original = LexicalGrounder.ground_views

    def counting(self: LexicalGrounder, views, tbox):  # type: ignore[no-untyped-def]
        asked.append(len(views))
        return original(self, views, tbox)

    monkeypatch.setattr(LexicalGrounder, "ground_views", counting)
    plan = read_matrix(matrix)
    (first,) = run_matrix(plan, tmp_path / "out")
    assert asked == [2, 2]
    assert first.cells[0].evaluation.summary.ema == 100.0
    (again,) = run_matrix(plan, tmp_path / "out")
    assert asked == [2, 2]
    assert all(cell.was_stored for cell in again.cells)
    assert [c.evaluation.scores for c in again.cells] == [c.evaluation.scores for c in first.cells]
    run_matrix(plan, tmp_path / "out", refresh=True)
    assert len(asked) == 4


def test_resumes_an_interrupted_run(matrix: Path, tmp_path: Path) -> None:
    plan = read_matrix(matrix)
    seen = []

    def stop_after_one(result) -> None:  # type: ignore[no-untyped-def]
        seen.append(result.was_stored)
        if len(seen) == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_matrix(plan, tmp_path / "out", progress=stop_after_one)
    (result,) = run_matrix(plan, tmp_path / "out")
    assert [cell.was_stored for cell in result.cells] == [True, False]


def test_rescores_stored_answers_when_gold_changes(matrix: Path, tmp_path: Path) -> None:
    plan = read_matrix(matrix)
    run_matrix(plan, tmp_path / "out")
    (tmp_path / "gold.csv").write_text("path,class\n/World/Chair_1,Sofa\n/World/Table_1,Table\n")
    (result,) = run_matrix(plan, tmp_path / "out")
    assert result.cells[0].was_stored
    assert result.cells[0].evaluation.summary.ema == 50.0


def test_cascades_run_each_language_model_at_each_threshold(matrix: Path) -> None:
    text = matrix.read_text().replace("repeats = 2", "cascade = [0.5, 0.9]")
    matrix.write_text(text.replace('["lexical"]', '["lexical", "llm-B:openai:m"]'))
    cells = [cell for cell in read_matrix(matrix).cells() if cell.scene.name == "room" and cell.regime == "semantic"]
    assert [cell.method for cell in cells] == [
        "lexical",
        "llm-B:openai:m",
        "llm-B:openai:m, cascade 0.5",
        "llm-B:openai:m, cascade 0.9",
    ]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("repeats = 2", "cascade = [0.5]", "cascade needs a language model; expected a grounder like llm-B:MODEL"),
        ("repeats = 2", "cascade = 0.5", "cascade is 0.5; expected a list of confidences from 0 to 1"),
        ("repeats = 2", "cascade = [80]", "expected a list of confidences from 0 to 1"),
        ("repeats = 2", 'cascade = ["0.8"]', "expected a list of confidences from 0 to 1"),
        ("repeats = 2", "cascade = [true]", "expected a list of confidences from 0 to 1"),
        ('grounders = ["lexical"]', 'grounders = ["oracle"]', "grounder 'oracle' is unknown"),
        ('"opaque"', '"foggy"', "expected one of semantic"),
        ("repeats = 2", "repeat = 2", "matrix has the unknown key 'repeat'; expected"),
        ('gold = "gold.csv"', 'golden = "gold.csv"', "scene 'room' has the unknown key 'golden'"),
        ('gold = "gold.csv"', "", "scene 'room' has no gold"),
        ('"elsewhere"', '"room"', "matrix.toml: two scenes are called 'room'; expected different names"),
        ("repeats = 2", 'repeats = "x"', "repeats is 'x'; expected a whole number from 1"),
        ("repeats = 2", "repeats = 0", "repeats is 0; expected a whole number from 1"),
        ("repeats = 2", "repeats = 1.7", "repeats is 1.7; expected a whole number from 1"),
        ("repeats = 2", "repeats = true", "repeats is True; expected a whole number from 1"),
        ("repeats = 2", 'ablation = "no"', "ablation is 'no'; expected true or false"),
        ('"two things"', "2", "title is 2; expected a text"),
        ('["lexical"]', '"lexical"', "grounders is 'lexical'; expected a list of one name or more"),
        ('["lexical"]', "[1]", r"grounders is \[1\]; expected a list of one name or more"),
        ('["lexical"]', "[]", r"grounders is \[\]; expected a list of one name or more"),
        ('["semantic", "opaque"]', "[]", r"regimes is \[\]; expected a list of one name or more"),
        ('"gold.csv"', "3", "scene 'room': gold is 3; expected a text"),
        ("optional = true", "optional = 1", "scene 'elsewhere': optional is 1; expected true or false"),
        ('name = "room"', "name = 1", "a scene: name is 1; expected a text"),
        ('"scene.usda"', '"other.usda"', "other.usda does not exist"),
        ("[[scene]]", "[[scene", "cannot be read as a matrix"),
    ],
)
def test_rejects_a_malformed_matrix(matrix: Path, old: str, new: str, said: str) -> None:
    matrix.write_text(matrix.read_text().replace(old, new, 1))
    with pytest.raises(EvaluationError, match=said):
        read_matrix(matrix)


def test_rejects_a_single_table_of_a_scene(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    path.write_text('[scene]\npath = "a.usd"\ngold = "a.csv"\n')
    with pytest.raises(EvaluationError, match=r"scene is \{'path'.*; expected a table \[\[scene\]\] for each scene"):
        read_matrix(path)


def test_names_a_built_in_ontology(matrix: Path, tmp_path: Path) -> None:
    matrix.write_text(matrix.read_text().replace('"gold.csv"', '"gold.csv"\nontology = "places"'))
    (tmp_path / "gold.csv").write_text("path,class\n/World/Table_1,Roof\n")
    (result,) = run_matrix(read_matrix(matrix), tmp_path / "out")
    assert result.tbox.content_hash == load_places_tbox().content_hash
    (tmp_path / "places").write_text("")
    assert read_matrix(matrix).scenes[0].ontology == tmp_path / "places", "a file of this name"


def test_scores_scenes_of_one_name_on_their_own_gold(matrix: Path, tmp_path: Path) -> None:
    plan = read_matrix(matrix)
    (tmp_path / "other.csv").write_text("path,class\n/World/Chair_1,Sofa\n/World/Table_1,Sofa\n")
    twins = plan.scenes[0], replace(plan.scenes[0], gold=tmp_path / "other.csv")
    results = run_matrix(replace(plan, scenes=twins), tmp_path / "out")
    assert [result.cells[0].evaluation.summary.ema for result in results] == [100.0, 0.0]


def test_rejects_gold_of_another_scene(matrix: Path, tmp_path: Path) -> None:
    (tmp_path / "gold.csv").write_text("path,class\n/Flat/Sofa,Sofa\n")
    with pytest.raises(EvaluationError) as caught:
        run_matrix(read_matrix(matrix), tmp_path / "out")
    assert str(caught.value) == (
        f"{tmp_path}/gold.csv: none of its 1 paths is in {tmp_path}/scene.usda; expected the gold of this scene"
    )


def test_warns_of_gold_paths_that_are_not_on_the_stage(
    matrix: Path, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "gold.csv").write_text("path,class\n/World/Chair_1,DesignedChair\n/Flat/Sofa,Sofa\n")
    run_matrix(read_matrix(matrix), tmp_path / "out")
    said = f"{tmp_path}/gold.csv: 1 of 2 gold paths are not on the stage {tmp_path}/scene.usda, /Flat/Sofa for one"
    assert f"{said}; they count as wrong" in caplog.messages


def test_rejects_a_matrix_without_scenes(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    path.write_text('title = "x"\n')
    with pytest.raises(EvaluationError, match="has no scene"):
        read_matrix(path)
