"""Opening a stage, with everything OpenUSD has to say turned into diagnostics."""

import hashlib
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, Usd, UsdGeom, UsdPhysics, UsdUtils

from usd2kg.errors import SceneError
from usd2kg.scene.model import Diagnostic, StageFrame
from usd2kg.scene.options import ReadOptions

__all__ = ["OpenedStage", "captured_diagnostics", "error_text", "open_stage"]

_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
_USD_FALLBACK_METRES = 0.01


@dataclass(frozen=True)
class OpenedStage:
    """A composed stage and what opening it brought up."""

    stage: Any
    source: str
    """The file as the user named it; for a stage that was open already, its root layer."""
    frame: StageFrame
    content_hash: str
    diagnostics: tuple[Diagnostic, ...]
    unresolved: frozenset[str]
    """Paths of prims below which a reference or payload could not be found."""


def open_stage(source: Path | str | Usd.Stage, options: ReadOptions) -> OpenedStage:
    """Open `source` with all payloads loaded; a stage that is open already is taken as it stands.

    Raises:
        SceneError: the file is missing, is no USD file or is corrupt.
    """
    if isinstance(source, Usd.Stage):
        return _opened(source, source.GetRootLayer().identifier, [], options)
    source = Path(source)
    _check_file(source)
    try:
        with captured_diagnostics() as notes:
            stage = Usd.Stage.Open(str(source), Usd.Stage.LoadAll)
    except Tf.ErrorException as error:
        raise SceneError(_cannot_open(source, error_text(error))) from error
    if stage is None:
        raise SceneError(_cannot_open(source, _shorten("; ".join(note.message for note in notes))))
    return _opened(stage, str(source), notes, options)


def _opened(stage: Any, source: str, notes: list[Diagnostic], options: ReadOptions) -> OpenedStage:
    composition = [_composition_diagnostic(error, stage) for error in stage.GetCompositionErrors()]
    frame, frame_notes = _read_frame(stage, options)
    return OpenedStage(
        stage=stage,
        source=source,
        frame=frame,
        content_hash=_hash_layers(stage),
        diagnostics=tuple(dict.fromkeys([*composition, *frame_notes, *_other_notes(notes, composition)])),
        unresolved=frozenset(note.prim_path for note in composition if note.prim_path not in {None, "/"}),
    )


@contextmanager
def captured_diagnostics() -> Iterator[list[Diagnostic]]:
    """Keep OpenUSD from writing to the terminal; the list holds what it had to say once the block is left."""
    # The delegate is process-wide: its notes are taken at once, before anybody else's arrive.
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    found: list[Diagnostic] = []
    try:
        yield found
    finally:
        notes = dict.fromkeys(note.commentary for note in delegate.TakeUncoalescedDiagnostics())
        found.extend(Diagnostic("openusd", _shorten(note), _prim_in(note)) for note in notes)


def error_text(error: Exception) -> str:
    """Return the first thing an error of OpenUSD says, on one line; empty if it says nothing."""
    try:
        return _shorten(str(error))
    except UnicodeDecodeError:
        # OpenUSD quotes the bytes that it could not read.
        return "it holds text that is not UTF-8"


def _check_file(source: Path) -> None:
    if not source.exists():
        raise SceneError(f"{source}: no such file; expected a USD stage ({', '.join(_SUFFIXES)})")
    if source.is_dir():
        raise SceneError(f"{source}: is a folder, expected a USD stage; name the root layer inside it")
    if source.stat().st_size == 0:
        raise SceneError(f"{source}: the file is empty, expected a USD stage; export it again")
    if not Sdf.FileFormat.FindByExtension(str(source)):
        raise SceneError(
            f"{source}: not a USD file (ending {source.suffix or 'missing'!r}), "
            f"expected one of {', '.join(_SUFFIXES)}; convert the scene to USD first"
        )


def _cannot_open(source: Path, reason: str) -> str:
    return f"{source}: OpenUSD cannot read this layer{f' ({reason})' if reason else ''}; export it again"


def _shorten(message: str, limit: int = 240) -> str:
    """Return the first thing the message says, on one line, without the places in OpenUSD's own code."""
    texts = re.split(r"'?\s*Error in '[^']*' at line \d+ in file \S+ : '?", message.strip())
    first = next((text for text in texts if text.strip(" '")), "")
    line = " ".join(first.split()).removeprefix("Encountered: ").rstrip("'")
    return line if len(line) <= limit else line[: limit - 1] + "…"


def _composition_diagnostic(error: Any, stage: Any) -> Diagnostic:
    text = str(error)
    # The error's own fields name the root layer only; its text names the layer that holds the broken arc.
    introduced_by = re.search(r"introduced by @([^@]+)@", text)
    layer = introduced_by.group(1) if introduced_by else stage.GetRootLayer().identifier
    return Diagnostic("composition", _shorten(text), str(error.rootSite.path), layer)


def _other_notes(notes: Iterable[Diagnostic], composition: Iterable[Diagnostic]) -> list[Diagnostic]:
    # The stage repeats its composition errors as warnings; those are told already, with their prims.
    told = [diagnostic.message.rstrip("…") for diagnostic in composition]
    return [note for note in notes if not any(message[:160] in note.message for message in told)]


def _prim_in(note: str) -> str | None:
    found = re.search(r"<(/[^>]*)>", note)
    return found.group(1) if found else None


def _read_frame(stage: Any, options: ReadOptions) -> tuple[StageFrame, list[Diagnostic]]:
    notes: list[Diagnostic] = []
    layer = stage.GetRootLayer().identifier
    metres = options.metres_per_unit or _metadata(stage, UsdGeom.Tokens.metersPerUnit)
    is_authored = isinstance(metres, int | float) and 0 < metres < float("inf")
    if metres is not None and not is_authored:
        notes.append(
            Diagnostic("units", f"metersPerUnit is {metres!r}, expected a positive number; 0.01 is used", None, layer)
        )
    if metres is None:
        notes.append(
            Diagnostic("units", "metersPerUnit is not authored; OpenUSD's fallback of 0.01 m is used", None, layer)
        )
    up_axis = options.up_axis or _metadata(stage, UsdGeom.Tokens.upAxis)
    if up_axis not in {"Y", "Z", None}:
        notes.append(Diagnostic("units", f"upAxis is {str(up_axis)!r}, expected Y or Z; Y is used", None, layer))
    kilograms = _metadata(stage, UsdPhysics.Tokens.kilogramsPerUnit)
    has_kilograms = isinstance(kilograms, int | float) and 0 < kilograms < float("inf")
    if kilograms is not None and not has_kilograms:
        message = f"kilogramsPerUnit is {kilograms!r}, expected a positive number; 1 is used"
        notes.append(Diagnostic("units", message, None, layer))
    frame = StageFrame(
        up_axis="Z" if up_axis == "Z" else "Y",
        metres_per_unit=_as_double(metres) if is_authored else _USD_FALLBACK_METRES,
        kilograms_per_unit=_as_double(kilograms) if has_kilograms else 1.0,
        is_authored=is_authored,
    )
    return frame, notes


def _metadata(stage: Any, key: str) -> Any:
    # Not UsdGeom.GetStageMetersPerUnit: it raises where the value is authored with another type than double.
    return stage.GetMetadata(key) if stage.HasAuthoredMetadata(key) else None


def _as_double(value: float) -> float:
    # A value authored as a 32-bit float (0.01 reads 0.00999999977…) means the number that was typed.
    return float(f"{value:.7g}")


def _hash_layers(stage: Any) -> str:
    digests = []
    for layer in stage.GetUsedLayers():
        path = Path(layer.realPath) if layer.realPath else None
        if path is not None and path.is_file() and not layer.dirty:
            digests.append(hashlib.sha256(path.read_bytes()).hexdigest())
        elif not layer.empty:
            # What was changed in memory is in no file.
            digests.append(hashlib.sha256(layer.ExportToString().encode()).hexdigest())
    return "sha256:" + hashlib.sha256("".join(sorted(digests)).encode()).hexdigest()
