"""A person who confirms a class changes no relation."""

from pathlib import Path

import usd2kg
from usd2kg.grounding import Decision, apply_decisions, ground
from usd2kg.ontology import load_tbox
from usd2kg.relations import find_relations
from usd2kg.scene import read_scene

ROOT = Path(usd2kg.__file__).parents[2]


def test_relations_are_those_of_the_prediction():
    scene = read_scene(ROOT / "benchmarks/scenes/flat/flat.usda")
    tbox = load_tbox(ROOT / "benchmarks/validation/twelve.ttl")
    predicted = ground(scene, tbox, "lexical")
    confirmed = {p.prim_path: Decision(p.class_iri, "ada") for p in predicted.predictions}
    before, after = (
        [(r.kind, r.target, r.anchor) for r in find_relations(scene, tbox, grounding)]
        for grounding in (predicted, apply_decisions(predicted, confirmed, scene, tbox))
    )
    assert {"on", "inside", "connects"} <= {kind for kind, _, _ in before}
    assert after == before
