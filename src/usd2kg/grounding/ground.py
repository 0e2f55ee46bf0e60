"""ground: classify the objects of a scene."""

from collections.abc import Iterable, Mapping

from usd2kg.errors import GroundingError
from usd2kg.garbage import paused_collection
from usd2kg.grounding.base import Grounder
from usd2kg.grounding.concepts import add_concepts
from usd2kg.grounding.context.views import ABBREVIATED_LENGTH, EVIDENCE_GROUPS, NamingRegime, view_objects
from usd2kg.grounding.decisions import DecisionOrigin, decide, make_decision
from usd2kg.grounding.model import Decision, Grounding, Prediction, Status
from usd2kg.grounding.predicted_labels import limit_to_stated
from usd2kg.grounding.registry import GROUNDERS, make_grounder
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import Scene
from usd2kg.tracing import traced
from usd2kg.version import VERSION

__all__ = ["ground", "parse_evidence", "parse_regime"]


@traced("ground", lambda grounding: {"objects": len(grounding.predictions)})
def ground(
    scene: Scene,
    tbox: TBox,
    grounder: Grounder | str = "lexical",
    *,
    regime: NamingRegime = NamingRegime.SEMANTIC,
    evidence: frozenset[str] | None = None,
    paths: Iterable[str] | None = None,
    decisions: Mapping[str, ClassIRI | Decision] | None = None,
    carried: Mapping[str, DecisionOrigin] | None = None,
    abbreviated_length: int = ABBREVIATED_LENGTH,
) -> Grounding:
    """Return a class of `tbox` for each object of `scene`.

    Args:
        scene: the objects; all of them serve as context, also those not in `paths`.
        tbox: the candidate classes.
        grounder: a grounder or the name of one.
        regime: how names are masked.
        evidence: names of the evidence groups to use; all by default.
        paths: ground only these prims, in this order; prims that are not on the stage get the status `missing`.
        decisions: prim path → class that a person decided on, alone or with the reviewer. `Prediction.review` keeps
            what a built-in grounder predicted; these objects are not passed to other grounders, whose answers may cost
            something.
        carried: prim path → origin, for decisions that were made about another path.
        abbreviated_length: letters kept of each word in the abbreviated regime.
    """
    if isinstance(grounder, str):
        grounder = make_grounder(grounder)
    with paused_collection():
        views = {obj.prim_path: view for obj, view in view_objects(scene, regime, evidence, abbreviated_length)}
    wanted = list(dict.fromkeys(paths)) if paths is not None else list(views)
    origins = carried or {}
    decided = {path: made for path, made in (decisions or {}).items() if path in views}
    passed = [path for path in wanted if path in views and (grounder.name in GROUNDERS or path not in decided)]
    predictions = grounder.ground_views([(path, views[path]) for path in passed], tbox)
    if evidence is None or "labels" in evidence:
        predictions = limit_to_stated(predictions, scene)
    grounded = {p.prim_path: p for p in predictions}
    for path, made in decided.items():
        found = grounded.get(path)
        origin = origins.get(path)
        grounded[path] = make_decision(path, made, origin) if found is None else decide(found, made, tbox, origin)
    by_path, concepts = add_concepts(grounded, views, tbox)
    return Grounding(
        scene=scene.source,
        scene_hash=scene.content_hash,
        ontology=tbox.ontology_iri,
        ontology_hash=tbox.content_hash,
        grounder=grounder.name,
        settings={
            "regime": regime.value,
            **({"abbreviated_length": str(abbreviated_length)} if regime is NamingRegime.ABBREVIATED else {}),
            "evidence": ",".join(sorted(evidence if evidence is not None else EVIDENCE_GROUPS)),
            **grounder.settings,
        },
        is_calibrated=grounder.is_calibrated,
        tool_version=VERSION,
        predictions=tuple(by_path.get(path) or _missing(path, grounder.name) for path in wanted),
        concepts=concepts,
    )


def _missing(path: str, grounder: str) -> Prediction:
    return Prediction(path, None, None, Status.MISSING, grounder, "there is no such prim on the stage")


def parse_regime(text: str) -> NamingRegime:
    """Return the naming regime called `text`.

    Raises:
        GroundingError: the regime is unknown.
    """
    try:
        return NamingRegime(text)
    except ValueError as error:
        known = ", ".join(NamingRegime)
        raise GroundingError(f"regime {text!r} is unknown; expected one of {known}") from error


def parse_evidence(text: str) -> frozenset[str]:
    """Return the evidence groups of a comma-separated list.

    Raises:
        GroundingError: a group is unknown, or the list is empty.
    """
    groups = frozenset(part.strip() for part in text.split(",") if part.strip())
    unknown = sorted(groups - EVIDENCE_GROUPS)
    if unknown or not groups:
        found = f"group {unknown[0]!r} is unknown" if unknown else "no group is named"
        raise GroundingError(f"evidence: {found}; expected a list of {', '.join(sorted(EVIDENCE_GROUPS))}")
    return groups
