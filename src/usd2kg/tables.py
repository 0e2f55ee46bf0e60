"""Build results as pandas or Polars data frames."""

import importlib
from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.errors import GraphError
from usd2kg.graph import individual_iri
from usd2kg.grounding import Prediction
from usd2kg.ontology import TBox
from usd2kg.pipeline import BuildResult
from usd2kg.scene import SceneObject

__all__ = ["Tables", "to_columns", "to_tables"]

Floats = NDArray[np.float64]
Columns = Mapping[str, Sequence[Any] | Floats]
_AXES = "xyz"


class Tables(NamedTuple):
    """Data frames with one row per object, relation, candidate and joint.

    Lengths are metres, masses kilograms and joint angles radians, in the z-up world frame. Unknown values are NaN in
    pandas and null in Polars.
    """

    objects: Any
    """`path`, `iri`, `name`, `class_iri`, `class_name`, `confidence`, `status`, `grounder`, `explanation`,
    `concept_iri`, `concept`, `concept_confidence`, `parent`, `center_x` … `size_z` of the box with all descendants,
    `position_x` … `position_z`, `qx` … `qw`, `mass_kg`."""
    relations: Any
    """`kind`, prim paths `target`, `anchor` and `other_anchor`, `rule`, `confidence`, and one column per measurement
    (`gap`, `distance`…; `angle` in degrees)."""
    candidates: Any
    """`path`, `rank` (from 1), `class_iri`, `class_name`, `score`."""
    joints: Any
    """`path`, `type`, `body0`, `body1`, `axis`, `lower`, `upper`, `value`: radians, or metres for prismatic joints."""


def to_tables(result: BuildResult, library: Literal["pandas", "polars"] = "pandas") -> Tables:
    """Return the objects, relations, candidates and joints of a build as data frames.

    Args:
        result: the result of `usd2kg.build`.
        library: pandas (extra `tables`) or Polars.

    Raises:
        GraphError: the library is unknown or not installed.
    """
    if library not in {"pandas", "polars"}:
        raise GraphError(f"tables: unknown library {library!r}; expected pandas or polars")
    try:
        frames = importlib.import_module(library)
    except ModuleNotFoundError as error:
        install = "usd2kg[tables]" if library == "pandas" else library
        raise GraphError(f"tables: {library} is not installed; run: pip install '{install}'") from error
    columns = to_columns(result)
    if library == "polars":
        return Tables(*(frames.DataFrame(table, nan_to_null=True) for table in columns))
    return Tables(*map(frames.DataFrame, columns))


def to_columns(result: BuildResult) -> tuple[Columns, Columns, Columns, Columns]:
    """Return the columns of the tables, in the order of `Tables`; numbers are float64 arrays, NaN where unknown."""
    return _objects(result), _relations(result), _candidates(result), _joints(result)


def _objects(result: BuildResult) -> Columns:
    objects, by_path = result.scene.objects, result.grounding.by_path
    predictions = [by_path.get(obj.prim_path) for obj in objects]
    concepts = [result.grounding.concepts.get(p.concept) if p and p.concept else None for p in predictions]
    columns: dict[str, Sequence[Any] | Floats] = {
        "path": [obj.prim_path for obj in objects],
        "iri": [individual_iri(result.graph.base, obj.prim_path) for obj in objects],
        "name": [obj.display_name or obj.name for obj in objects],
        "class_iri": [p.class_iri if p else None for p in predictions],
        "class_name": [_class_name(p, result.tbox) for p in predictions],
        "confidence": _numbers([p.confidence if p else None for p in predictions]),
        "status": [p.status.value if p else None for p in predictions],
        "grounder": [p.grounder if p else None for p in predictions],
        "explanation": [p.explanation if p else None for p in predictions],
        "concept_iri": [concept.iri if concept else None for concept in concepts],
        "concept": [concept.label if concept else None for concept in concepts],
        "concept_confidence": _numbers([p.concept_confidence if p else None for p in predictions]),
        "parent": [obj.parent_path for obj in objects],
    }
    return columns | _geometry(objects)


def _class_name(prediction: Prediction | None, tbox: TBox) -> str | None:
    return tbox.by_iri[prediction.class_iri].local_name if prediction and prediction.class_iri else None


def _geometry(objects: Sequence[SceneObject]) -> dict[str, Sequence[Any] | Floats]:
    vectors = {
        "center_": [obj.box.center if obj.box else None for obj in objects],
        "size_": [obj.box.size if obj.box else None for obj in objects],
        "position_": [obj.position for obj in objects],
    }
    columns = {
        f"{name}{axis}": _numbers([vector[i] if vector else None for vector in values])
        for name, values in vectors.items()
        for i, axis in enumerate(_AXES)
    }
    quaternions = [obj.orientation for obj in objects]
    columns |= {f"q{axis}": _numbers([q[i] if q else None for q in quaternions]) for i, axis in enumerate("xyzw")}
    return {**columns, "mass_kg": _numbers([obj.mass_kg for obj in objects])}


def _relations(result: BuildResult) -> Columns:
    relations = result.graph.relations
    measures = sorted({name for relation in relations for name in relation.numbers})
    return {
        "kind": [relation.kind for relation in relations],
        "target": [relation.target for relation in relations],
        "anchor": [relation.anchor for relation in relations],
        "other_anchor": [relation.other_anchor for relation in relations],
        "rule": [relation.rule for relation in relations],
        "confidence": _numbers([relation.confidence for relation in relations]),
        **{name: _numbers([relation.numbers.get(name) for relation in relations]) for name in measures},
    }


def _candidates(result: BuildResult) -> Columns:
    rows = [
        (prediction.prim_path, rank, candidate)
        for prediction in result.grounding.predictions
        for rank, candidate in enumerate(prediction.candidates, start=1)
    ]
    return {
        "path": [path for path, _, _ in rows],
        "rank": [rank for _, rank, _ in rows],
        "class_iri": [candidate.class_iri for _, _, candidate in rows],
        "class_name": [result.tbox.by_iri[candidate.class_iri].local_name for _, _, candidate in rows],
        "score": _numbers([candidate.score for _, _, candidate in rows]),
    }


def _joints(result: BuildResult) -> Columns:
    joints = result.scene.joints
    return {
        "path": [joint.prim_path for joint in joints],
        "type": [joint.type for joint in joints],
        "body0": [joint.body0 for joint in joints],
        "body1": [joint.body1 for joint in joints],
        "axis": [joint.axis for joint in joints],
        "lower": _numbers([joint.lower for joint in joints]),
        "upper": _numbers([joint.upper for joint in joints]),
        "value": _numbers([joint.value for joint in joints]),
    }


def _numbers(values: Sequence[float | None]) -> Floats:
    return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
