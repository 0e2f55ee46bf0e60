"""A tiny scene with results whose metrics are computed by hand, shared by the report tests."""

from collections.abc import Mapping
from pathlib import Path

from usd2kg.evaluation import CellResult, GoldLabel, SceneResult
from usd2kg.evaluation.matrix import OWN_ABLATION, STUDY_ABLATION, Cell, SceneSpec
from usd2kg.evaluation.metrics.selection_scores import SelectionScore
from usd2kg.evaluation.model_cost import ModelCost
from usd2kg.evaluation.run import score_grounding
from usd2kg.grounding import Grounding, NamingRegime, Prediction, Status
from usd2kg.ontology import OntologyClass, TBox
from usd2kg.scene import Box, Scene, SceneObject, StageFrame

NS = "http://example.org/home#"
HIERARCHY = {"Artifact": None, "Container": "Artifact", "Bowl": "Container", "Cup": "Container"} | {
    "Furniture": "Artifact",
    "Table": "Furniture",
}
GOLD = {"/W/Cup_1": "Cup", "/W/Cup_2": "Cup", "/W/Bowl_1": "Bowl", "/W/Desk_1": "Table"}
Answers = Mapping[str, tuple[str, float]]

FIRST: Answers = {
    "/W/Cup_1": ("Cup", 0.9),
    "/W/Cup_2": ("Container", 0.6),  # superclass collapse
    "/W/Bowl_1": ("Cup", 0.6),  # a sibling, and a second label
    "/W/Desk_1": ("Table", 0.8),
}
SECOND: Answers = {"/W/Cup_1": ("Cup", 1.0)}


def tbox(hierarchy: Mapping[str, str | None] = HIERARCHY) -> TBox:
    classes = [
        OntologyClass(NS + name, name, (), "", (NS + parent,) if parent else ()) for name, parent in hierarchy.items()
    ]
    return TBox("/somewhere/home.owl", NS, None, "sha256:0", tuple(sorted(classes, key=lambda cls: cls.iri)))


def scene(paths: Mapping[str, str]) -> Scene:
    objects = tuple(_object(path) for path in paths)
    return Scene("/somewhere/tiny.usda", "sha256:1", StageFrame("Z", 1.0, 1.0, True), None, 9, objects, {})


def _object(path: str) -> SceneObject:
    box = Box((0.0, 0.0, 0.0), (1.6, 0.8, 0.7))
    name = path.rpartition("/")[2]
    plain = {"type_name": "Xform", "kind": "", "selected_by": "", "parent_path": None, "display_name": ""}
    return SceneObject(
        prim_path=path, name=name, box=box, own_box=box, part_boxes=(), position=None, orientation=None, mass_kg=None,
        documentation="", asset=(), materials=(), parts=(), display_color=None, instance_of=None, **plain,
    )  # fmt: skip


def run(
    spec: SceneSpec, method: str, condition: str, answers: Answers, gold: tuple[GoldLabel, ...], classes: TBox,
    *, repeat: int = 1, seconds: float = 0.4, missed: tuple[str, ...] = (), cascade: float | None = None,
    cost: ModelCost | None = None,
) -> CellResult:  # fmt: skip
    ablation = {**STUDY_ABLATION, **OWN_ABLATION}.get(condition)
    regime = ablation[0] if ablation else NamingRegime(condition)
    evidence = frozenset(ablation[1].split(",")) if ablation else None
    predictions = tuple(
        Prediction(path, NS + name, confidence, Status.GROUNDED, method, "because")
        for path, (name, confidence) in answers.items()
    )
    grounding = Grounding("/somewhere/tiny.usda", "sha256:1", NS, "sha256:0", method, {}, True, "0", predictions)
    cell = Cell(spec, method, condition, regime, evidence, repeat, cascade)
    evaluation = score_grounding(grounding, gold, classes, seconds, missed=missed)
    return CellResult(cell, evaluation, was_stored=False, cost=cost)


def tiny(
    runs: Mapping[tuple[str, str], Answers] | None = None,
    *,
    name: str = "Tiny",
    gold: Mapping[str, str] = GOLD,
    hierarchy: Mapping[str, str | None] = HIERARCHY,
    missed: tuple[str, ...] = (),
    repeats: tuple[Answers, ...] = (),
    seconds: float = 0.4,
) -> SceneResult:
    """Return results on the tiny scene, by default of two methods under authored names.

    Args:
        runs: (method, condition) → prim path → (class, confidence).
        repeats: further repeats of the method `first` under authored names.
    """
    spec = SceneSpec(name, Path("/somewhere/tiny.usda"), Path("/somewhere/gold.csv"), None, "made up", False)
    classes = tbox(hierarchy)
    also = {"/W/Bowl_1": frozenset({NS + "Cup"})}
    labels = tuple(GoldLabel(path, NS + cls, also.get(path, frozenset())) for path, cls in gold.items())
    runs = {("first", "semantic"): FIRST, ("second", "semantic"): SECOND} if runs is None else runs
    cells = [run(spec, *key, answers, labels, classes, seconds=seconds, missed=missed) for key, answers in runs.items()]
    cells += [
        run(spec, "first", "semantic", answers, labels, classes, repeat=number, seconds=seconds)
        for number, answers in enumerate(repeats, 2)
    ]
    selection = SelectionScore(1 - len(missed) / len(labels), 0.5, missed, ("/W/Lamp",))
    return SceneResult(spec, scene(gold), classes, labels, selection, tuple(cells))
