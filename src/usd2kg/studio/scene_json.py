"""The scene as JSON for the page; the records are documented in `web/src/api/types.ts`."""

from collections import Counter
from typing import Any

from usd2kg.graph.vocabulary import SOMA
from usd2kg.relations.object_kinds import ObjectKind, find_kinds
from usd2kg.scene import SceneObject
from usd2kg.scene.sanity_checks import find_outliers
from usd2kg.studio.object_review import ObjectReview
from usd2kg.studio.page_indices import NONE, PageIndices
from usd2kg.studio.session import StudioSession

__all__ = ["scene_json", "state_json"]


def scene_json(session: StudioSession, indices: PageIndices, reviewer: str) -> dict[str, Any]:
    """Return what does not change during a session."""
    scene, tbox, grounding = session.scene, session.tbox, session.suggestions
    kinds = Counter(relation.kind for relation in session.relations)
    return {
        "title": scene.source.replace("\\", "/").rpartition("/")[2],
        "source": scene.source,
        "ontology": {"iri": tbox.ontology_iri, "label": tbox.source},
        "grounder": grounding.grounder,
        "second_grounder": session.second.grounder if session.second is not None else "",
        "is_calibrated": grounding.is_calibrated,
        "is_graph": bool(session.stage_note),
        "has_colors": any(obj.display_color is not None or obj.materials for obj in scene.objects),
        "limits": dict(session.limits),
        "reviewer": reviewer,
        "objects": _objects(session, indices),
        "classes": [
            {
                "iri": cls.iri,
                "name": cls.readable_name,
                "label": cls.label,
                "synonyms": cls.alt_labels,
                "definition": cls.comment,
                "parents": [indices.class_(parent) for parent in cls.parents],
            }
            for cls in tbox.classes
        ],
        "concepts": [
            {
                "iri": iri,
                "label": grounding.concepts[iri].label,
                "broader": [indices.concept(above) for above in grounding.concepts[iri].broader],
            }
            for iri in indices.concept_iris
        ],
        "relation_kinds": [{"kind": kind, "count": count} for kind, count in sorted(kinds.items())],
        "diagnostics": [
            {"code": note.code, "message": note.message, "path": note.prim_path} for note in scene.diagnostics
        ],
        "figures": _figures(session),
    }


def _objects(session: StudioSession, indices: PageIndices) -> dict[str, Any]:
    objects = indices.scene.objects
    mounts = {relation.target: relation.anchor for relation in session.relations if relation.kind == "attached-to"}
    outliers = find_outliers(session.scene)
    assets = {name: number for number, name in enumerate(dict.fromkeys(map(_asset, objects)))}
    return {
        "path": [obj.prim_path for obj in objects],
        "name": [obj.display_name or obj.name for obj in objects],
        "parent": [indices.object(obj.parent_path) for obj in objects],
        "box": [_box(obj) for obj in objects],
        "turned": [_turned(obj) for obj in objects],
        "room": [indices.room_of.get(obj.prim_path, NONE) for obj in objects],
        "rooms": [path.rpartition("/")[2] for path in indices.rooms],
        "is_outlier": [obj.prim_path in outliers for obj in objects],
        "asset": [assets[_asset(obj)] for obj in objects],
        "assets": list(assets),
        "color": [obj.display_color for obj in objects],
        "shell": [_shell(kind) for kind in find_kinds(session.scene, session.tbox, session.suggestions)],
        "mount": [indices.object(mounts.get(obj.prim_path)) for obj in objects],
    }


def _shell(kind: ObjectKind) -> str:
    """Return whether an object hides the interior of a room from outside."""
    names = {iri.rpartition("#")[2] for iri in kind.above if iri.startswith(SOMA.iri)}
    return "ceiling" if "Ceiling" in names else "wall" if "Wall" in names else ""


def _asset(obj: SceneObject) -> str:
    return obj.asset[0] if obj.asset else ""


def _box(obj: SceneObject) -> list[float] | None:
    box = obj.own_box or obj.box
    return None if box is None else [round(value, 4) for value in (*box.lower, *box.upper)]


def _turned(obj: SceneObject) -> list[float] | None:
    """Return the orientation and the extents along the object's own axes; None if those are the world's axes."""
    if obj.orientation is None or obj.oriented_size is None:
        return None
    return [round(value, 4) for value in (*obj.orientation, *obj.oriented_size)]


def _figures(session: StudioSession) -> list[dict[str, str]]:
    scene, grounding = session.scene, session.suggestions
    figures = {
        **({"Meshes": session.stage_note} if session.stage_note else {}),
        "Objects": f"{len(scene.objects):,}",
        **({} if session.stage_note else {"Prims": f"{scene.prim_count:,}"}),
        **{f"Left out: {reason}": f"{count:,}" for reason, count in scene.left_out.items()},
        "Up axis": scene.frame.up_axis,
        "Metres per unit": f"{scene.frame.metres_per_unit:g}",
        "Ontology": session.tbox.source,
        "Classes in scope": f"{len(session.tbox.classes):,}",
        "Grounder": grounding.grounder,
        **{f"Grounder: {name}": value for name, value in grounding.settings.items()},
        "Relations": f"{len(session.relations):,}",
        "Stage": scene.content_hash,
        "usd2kg": grounding.tool_version,
    }
    return [{"label": label, "value": value} for label, value in figures.items()]


def state_json(state: ObjectReview, indices: PageIndices) -> dict[str, Any]:
    """Return the state of one object."""
    prediction, verdict = state.prediction, state.verdict
    before = prediction.review
    return {
        "object": indices.object(state.prim_path),
        "state": state.status.value,
        "class": indices.class_(state.class_iri),
        "confidence": state.confidence,
        "suggested": indices.class_(prediction.class_iri),
        "concept": indices.concept(prediction.concept),
        "reviewer": verdict.reviewer or (before.reviewer if before is not None else ""),
        "time": verdict.time or (before.time if before is not None else ""),
        "comment": verdict.comment or (before.comment if before is not None else ""),
        "proposal": verdict.proposal,
        "is_conflict": state.is_conflict,
    }
