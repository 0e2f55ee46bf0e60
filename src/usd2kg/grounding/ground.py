"""ground: run a grounder over the objects of a scene."""

from collections.abc import Iterable, Mapping

from usd2kg.errors import GroundingError
from usd2kg.grounding.base import Grounder
from usd2kg.grounding.context.views import ABBREVIATED_LENGTH, EVIDENCE_GROUPS, NamingRegime, view_objects
from usd2kg.grounding.decisions import Carried, decided
from usd2kg.grounding.model import Grounding, Prediction, Status
from usd2kg.grounding.registry import make_grounder
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import Scene

__all__ = ["ground", "parse_evidence", "parse_regime"]


def ground(
    scene: Scene,
    tbox: TBox,
    grounder: Grounder | str = "lexical",
    *,
    regime: NamingRegime = NamingRegime.SEMANTIC,
    evidence: frozenset[str] | None = None,
    paths: Iterable[str] | None = None,
    decisions: Mapping[str, ClassIRI] | None = None,
    carried: Mapping[str, Carried] | None = None,
    abbreviated_length: int = ABBREVIATED_LENGTH,
) -> Grounding:
    """Return a class of `tbox` for each object of `scene`.

    Args:
        scene: the objects; all of them are context for each other, whatever is asked for.
        tbox: the classes to choose from.
        grounder: who chooses: a grounder, or the name of one.
        regime: how the names are masked.
        evidence: names of the evidence groups that may be used; all by default.
        decisions: prim path → class for what a person has decided; the grounder is not asked about it.
        carried: prim path → where its decision comes from, of decisions that were made about another path.
        abbreviated_length: letters kept of each word in the abbreviated regime.
        paths: answer for these prims only, in this order; those not on the stage get the status `missing`.
    """
    # It reads e-mail headers, which takes as long as a hundred names.
    from importlib.metadata import version  # noqa: PLC0415

    if isinstance(grounder, str):
        grounder = make_grounder(grounder)
    views = {obj.prim_path: view for obj, view in view_objects(scene, regime, evidence, abbreviated_length)}
    wanted = list(dict.fromkeys(paths)) if paths is not None else list(views)
    origins = carried or {}
    known = {path: decided(path, iri, origins.get(path)) for path, iri in (decisions or {}).items() if path in views}
    found = [(path, views[path]) for path in wanted if path in views and path not in known]
    by_path = known | {p.prim_path: p for p in grounder.ground_views(found, tbox)}
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
        tool_version=version("usd2kg"),
        predictions=tuple(by_path.get(path) or _missing(path, grounder.name) for path in wanted),
    )


def _missing(path: str, grounder: str) -> Prediction:
    return Prediction(path, None, None, Status.MISSING, grounder, "there is no such prim on the stage")


def parse_regime(text: str) -> NamingRegime:
    """Return the regime that a user names.

    Raises:
        GroundingError: there is no such regime.
    """
    try:
        return NamingRegime(text)
    except ValueError as error:
        known = ", ".join(NamingRegime)
        raise GroundingError(f"regime {text!r} is unknown; expected one of {known}") from error


def parse_evidence(text: str) -> frozenset[str]:
    """Return the evidence groups of a comma-separated list.

    Raises:
        GroundingError: one of them is no evidence group, or none is named.
    """
    groups = frozenset(part.strip() for part in text.split(",") if part.strip())
    unknown = sorted(groups - EVIDENCE_GROUPS)
    if unknown or not groups:
        found = f"group {unknown[0]!r} is unknown" if unknown else "no group is named"
        raise GroundingError(f"evidence: {found}; expected a list of {', '.join(sorted(EVIDENCE_GROUPS))}")
    return groups
