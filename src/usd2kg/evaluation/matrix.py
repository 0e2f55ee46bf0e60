"""Run matrices: scenes × grounders × conditions × repeats, read from TOML files."""

import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

from usd2kg.errors import EvaluationError, GroundingError
from usd2kg.grounding import GROUNDERS, NamingRegime, is_llm_name, parse_evidence
from usd2kg.ontology import BUILT_IN_NAMES

__all__ = ["OWN_ABLATION", "STUDY_ABLATION", "Ablation", "Cell", "Matrix", "SceneSpec", "read_matrix"]

Ablation = Mapping[str, tuple[NamingRegime, str]]
"""Condition → naming regime and comma-separated evidence groups."""

STUDY_ABLATION: Ablation = {
    "geometry only": (NamingRegime.OPAQUE, "geometry"),
    "hierarchy only": (NamingRegime.OPAQUE, "hierarchy"),
    "geometry + position": (NamingRegime.OPAQUE, "geometry,position"),
    "position only": (NamingRegime.OPAQUE, "position"),
    "full context, anonymised": (NamingRegime.OPAQUE_ANONYMOUS, "geometry,position,hierarchy"),
    "hierarchy only, anonymised": (NamingRegime.OPAQUE_ANONYMOUS, "hierarchy"),
}
"""The six conditions of the study, under opaque names: condition → (regime, evidence groups)."""

OWN_ABLATION: Ablation = {
    "name only": (NamingRegime.SEMANTIC, "name"),
    "name + hierarchy": (NamingRegime.SEMANTIC, "name,hierarchy"),
    "name + asset": (NamingRegime.SEMANTIC, "name,asset"),
    "all but the name": (NamingRegime.SEMANTIC, "geometry,position,hierarchy,asset,materials,parts"),
    "asset only": (NamingRegime.SEMANTIC, "asset"),
    "parts only": (NamingRegime.SEMANTIC, "parts"),
}
"""Further conditions, under authored names."""

_Condition = tuple[str, NamingRegime, frozenset[str] | None]
"""Name, naming regime and evidence groups."""
_KEYS = {"title", "regimes", "grounders", "repeats", "ablation", "cascade", "scene"}
_SCENE_KEYS = {"name", "path", "gold", "ontology", "optional", "note"}


@dataclass(frozen=True, slots=True)
class SceneSpec:
    """One scene of a matrix, with absolute paths."""

    name: str
    path: Path
    gold: Path
    ontology: Path | None
    """A file, or the name of a built-in TBox; None for that of homes."""
    note: str
    """Remark printed next to the results: who labelled the scene, and whether it is tuning data."""
    is_optional: bool
    """Whether the scene is skipped if its files are missing; otherwise that is an error."""

    @property
    def missing(self) -> Path | None:
        """The first file that does not exist; None if all exist."""
        has_file = self.ontology is not None and str(self.ontology) not in BUILT_IN_NAMES
        files = (self.path, self.gold, *((self.ontology,) if self.ontology is not None and has_file else ()))
        return next((file for file in files if not file.exists()), None)


@dataclass(frozen=True, slots=True)
class Cell:
    """One run of the matrix."""

    scene: SceneSpec
    grounder: str
    condition: str
    """Name of the naming regime or of the ablation condition."""
    regime: NamingRegime
    evidence: frozenset[str] | None
    repeat: int
    cascade: float | None = None
    """Confidence of the lexical grounder below which the language model `grounder` is asked; None asks it always."""

    @property
    def method(self) -> str:
        """Name of the grounder in reports, with the threshold of a cascade."""
        return self.grounder if self.cascade is None else f"{self.grounder}, cascade {self.cascade:g}"


@dataclass(frozen=True)
class Matrix:
    """Scenes, grounders and conditions to run."""

    title: str
    scenes: tuple[SceneSpec, ...]
    grounders: tuple[str, ...]
    regimes: tuple[NamingRegime, ...]
    repeats: int
    """Runs of each language model under each condition, with samples of their own. Other grounders run once, since they
    always give the same answers."""
    ablation: Ablation = field(default_factory=dict)
    """Ablation conditions; empty for none."""
    ablated: tuple[str, ...] = ()
    """The grounders that are run under the ablation conditions."""
    cascades: tuple[float, ...] = ()
    """Thresholds at which each language model is also run behind the lexical grounder, under `regimes`."""

    @property
    def language_models(self) -> tuple[str, ...]:
        """The grounders that ask a language model."""
        return tuple(name for name in self.grounders if is_llm_name(name))

    def cells(self) -> Iterator[Cell]:
        """Yield the runs, scene by scene."""
        named = [(regime.value, regime, None) for regime in self.regimes]
        ablated = [(name, regime, parse_evidence(groups)) for name, (regime, groups) in self.ablation.items()]
        for scene in self.scenes:
            for grounder in self.grounders:
                yield from self._repeat(scene, grounder, [*named, *(ablated if grounder in self.ablated else ())])
            for model in self.language_models:
                for threshold in self.cascades:
                    yield from self._repeat(scene, model, named, threshold)

    def _repeat(
        self, scene: SceneSpec, grounder: str, conditions: Iterable[_Condition], cascade: float | None = None
    ) -> Iterator[Cell]:
        repeats = self.repeats if is_llm_name(grounder) else 1
        for name, regime, evidence in conditions:
            for repeat in range(1, repeats + 1):
                yield Cell(scene, grounder, name, regime, evidence, repeat, cascade)


def read_matrix(path: Path | str) -> Matrix:
    """Return the matrix in a TOML file; its paths are relative to the file.

    Raises:
        EvaluationError: the file cannot be read, or has an unknown key, grounder or regime, a value of another
            type, or two scenes of one name.
    """
    path = Path(path)
    try:
        data = tomllib.loads(path.read_text("utf-8"))
    except (OSError, UnicodeDecodeError, RecursionError, tomllib.TOMLDecodeError) as error:
        raise EvaluationError(
            f"{path}: cannot be read as a matrix ({error}); expected TOML, see docs/evaluation.md"
        ) from error
    _check_keys(path, "matrix", data, _KEYS)
    read = _Table(str(path), data)
    tables = data.get("scene", ())
    if not isinstance(tables, list | tuple) or not all(isinstance(table, dict) for table in tables):
        raise EvaluationError(f"{path}: scene is {tables!r}; expected a table [[scene]] for each scene")
    scenes = tuple(_read_scene_spec(path, table) for table in tables)
    if not scenes:
        raise EvaluationError(f"{path}: has no scene; expected at least one [[scene]] with path and gold")
    _check_distinct_names(path, scenes)
    grounders = _read_grounders(path, read.names("grounders", GROUNDERS))
    return Matrix(
        title=read.text("title", path.stem),
        scenes=scenes,
        grounders=grounders,
        regimes=_read_regimes(path, read.names("regimes", tuple(NamingRegime))),
        repeats=read.count("repeats", 1),
        ablation={**STUDY_ABLATION, **OWN_ABLATION} if read.switch("ablation") else {},
        ablated=grounders,
        cascades=_read_cascades(path, data.get("cascade", ()), grounders),
    )


@dataclass(frozen=True, slots=True)
class _Table:
    """A TOML table whose values are checked for their types."""

    where: str
    data: Mapping[str, Any]

    def text(self, key: str, default: str) -> str:
        value = self.data.get(key, default)
        return value if isinstance(value, str) else self._reject(key, "a text")

    def switch(self, key: str) -> bool:
        value = self.data.get(key, False)
        return value if isinstance(value, bool) else self._reject(key, "true or false")

    def count(self, key: str, default: int) -> int:
        value = self.data.get(key, default)
        # A bool is an int.
        return value if type(value) is int and value > 0 else self._reject(key, "a whole number from 1")

    def names(self, key: str, default: Sequence[str]) -> tuple[str, ...]:
        values = self.data.get(key, default)
        is_list = isinstance(values, list | tuple) and all(isinstance(value, str) for value in values)
        return tuple(dict.fromkeys(values)) if is_list and values else self._reject(key, "a list of one name or more")

    def _reject(self, key: str, expected: str) -> NoReturn:
        raise EvaluationError(f"{self.where}: {key} is {self.data[key]!r}; expected {expected}")


def _check_distinct_names(path: Path, scenes: Iterable[SceneSpec]) -> None:
    repeated = [name for name, count in Counter(scene.name for scene in scenes).items() if count > 1]
    if repeated:
        raise EvaluationError(f"{path}: two scenes are called {repeated[0]!r}; expected different names, set name")


def _read_cascades(path: Path, thresholds: Any, grounders: Iterable[str]) -> tuple[float, ...]:
    is_list = isinstance(thresholds, list | tuple)
    if not is_list or not all(type(number) in (int, float) and 0 <= number <= 1 for number in thresholds):
        raise EvaluationError(f"{path}: cascade is {thresholds!r}; expected a list of confidences from 0 to 1")
    if thresholds and not any(map(is_llm_name, grounders)):
        raise EvaluationError(f"{path}: cascade needs a language model; expected a grounder like llm-B:MODEL")
    return tuple(dict.fromkeys(map(float, thresholds)))


def _read_grounders(path: Path, names: tuple[str, ...]) -> tuple[str, ...]:
    unknown = [name for name in names if name not in GROUNDERS and not is_llm_name(name)]
    if unknown:
        known = ", ".join(GROUNDERS)
        raise EvaluationError(f"{path}: grounder {unknown[0]!r} is unknown; expected {known}, or llm-B:MODEL")
    return names


def _read_regimes(path: Path, names: Iterable[str]) -> tuple[NamingRegime, ...]:
    try:
        return tuple(NamingRegime(name) for name in names)
    except (ValueError, GroundingError) as error:
        raise EvaluationError(f"{path}: {error}; expected one of {', '.join(NamingRegime)}") from error


def _read_scene_spec(path: Path, spec: Mapping[str, Any]) -> SceneSpec:
    name = _Table(f"{path}: a scene", spec).text("name", str(spec.get("path", "unnamed")))
    where = f"scene {name!r}"
    _check_keys(path, where, spec, _SCENE_KEYS)
    for key in ("path", "gold"):
        if key not in spec:
            raise EvaluationError(f"{path}: {where} has no {key}; expected path and gold")
    read = _Table(f"{path}: {where}", spec)
    folder = path.resolve().parent
    scene = SceneSpec(
        name=name,
        path=folder / read.text("path", ""),
        gold=folder / read.text("gold", ""),
        ontology=_find_ontology(folder, read.text("ontology", "")),
        note=read.text("note", ""),
        is_optional=read.switch("optional"),
    )
    if scene.missing and not scene.is_optional:
        raise EvaluationError(
            f"{path}: scene {name!r}: {scene.missing} does not exist; fix the path or set optional = true"
        )
    return scene


def _find_ontology(folder: Path, name: str) -> Path | None:
    """Return an ontology beside the matrix, or the name of a built-in one; None if the scene names none."""
    if not name:
        return None
    file = folder / name
    return Path(name) if name in BUILT_IN_NAMES and not file.is_file() else file


def _check_keys(path: Path, table: str, data: Mapping[str, Any], known: set[str]) -> None:
    unknown = sorted(set(data) - known)
    if unknown:
        raise EvaluationError(
            f"{path}: {table} has the unknown key {unknown[0]!r}; expected {', '.join(sorted(known))}"
        )
