"""Open stages and read values; errors and warnings of OpenUSD become diagnostics.

A value of another type than expected, or one that OpenUSD cannot unpack, is read as None.
"""

import hashlib
import os
import re
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter
from pathlib import Path
from typing import Any, NamedTuple

from pxr import Sdf, Tf, Usd, UsdGeom, UsdUtils

from usd2kg.convert import (
    SCENE_ENDINGS,
    Origin,
    SourceFormat,
    find_format,
    read_origin,
    refuse_other_xml,
    stages_in,
)
from usd2kg.errors import SceneError
from usd2kg.files import hash_file
from usd2kg.scene.expansion import check_expansion
from usd2kg.scene.model import Diagnostic, StageFile, StageFrame
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.settings import LIMITS

__all__ = [
    "UNREADABLE",
    "OpenedStage",
    "captured_diagnostics",
    "error_text",
    "open_stage",
    "read_targets",
    "read_value",
    "time_code",
    "translated_errors",
    "value_of",
]

UNREADABLE = (Tf.ErrorException, UnicodeDecodeError)
"""Exceptions that any call of OpenUSD may raise if a file is corrupt."""

_STDERR = 2
"""File number of stderr, to which OpenUSD's C code writes."""
_ADVICE_ERROR = b"failed call to posix_madvise"
_USD_FALLBACK_METRES = 0.01
_NOT_UTF8 = "it holds text that is not UTF-8"


@dataclass(frozen=True)
class OpenedStage:
    """A composed stage with its diagnostics."""

    stage: Any
    source: str
    """The file as the user named it; for an already open stage, the identifier of its root layer."""
    frame: StageFrame
    diagnostics: tuple[Diagnostic, ...]
    unresolved: frozenset[str]
    """Paths of prims with a missing reference or payload at or below them."""
    origin: Origin | None
    """What the stage was converted from; None if it is not a conversion."""

    @cached_property
    def contents(self) -> "_StageContents":
        """Hash and files of all layers in use; the files are read on first access."""
        return _hash_layers(self.stage)

    @property
    def content_hash(self) -> str:
        """SHA-256 over all layers in use."""
        return self.contents.hash


class _StageContents(NamedTuple):
    """The layers that a stage was composed of."""

    hash: str
    files: tuple[StageFile, ...]


def open_stage(source: Path | str | Usd.Stage, options: ReadOptions) -> OpenedStage:
    """Return the stage of a file with all payloads loaded; an already open stage is used as it is.

    A file of another format is converted to a stage in memory.

    Raises:
        SceneError: the file is missing, corrupt, or neither a USD file nor of a format with an installed converter;
            or its instances stand for too many prims.
    """
    if isinstance(source, Usd.Stage):
        identifier = source.GetRootLayer().identifier
        with translated_errors(identifier):
            return _opened(source, identifier, [], options)
    source = Path(source)
    source_format = _check_file(source)
    if source_format is not None:
        return _convert(source, source_format, options)
    with translated_errors(str(source)):
        with captured_diagnostics() as notes, _without_advice_errors():
            stage = Usd.Stage.Open(str(source), Usd.Stage.LoadAll)
        if stage is None:
            raise SceneError(_cannot_open(str(source), _shorten("; ".join(note.message for note in notes))))
        return _opened(stage, str(source), notes, options)


def _convert(source: Path, source_format: SourceFormat, options: ReadOptions) -> OpenedStage:
    from usd2kg.convert.read import convert_stage  # noqa: PLC0415 - only for files of other formats

    with translated_errors(str(source)):
        with captured_diagnostics() as notes:
            converted = convert_stage(source, source_format)
        found = [*(Diagnostic("conversion", note) for note in converted.notes), *notes]
        return _opened(converted.stage, str(source), found, options)


def _opened(stage: Any, source: str, notes: list[Diagnostic], options: ReadOptions) -> OpenedStage:
    check_expansion(stage, source)
    composition = [_composition_diagnostic(error, stage) for error in stage.GetCompositionErrors()]
    frame, frame_notes = _read_frame(stage, options)
    return OpenedStage(
        stage=stage,
        source=source,
        frame=frame,
        diagnostics=tuple(dict.fromkeys([*composition, *frame_notes, *_other_notes(notes, composition)])),
        unresolved=frozenset(note.prim_path for note in composition if note.prim_path not in {None, "/"}),
        origin=read_origin(stage.GetLayerStack()),
    )


@contextmanager
def captured_diagnostics() -> Iterator[list[Diagnostic]]:
    """Redirect OpenUSD's messages from the terminal to the returned list, which is filled at the end of the block."""
    # The delegate is process-wide; take its messages before other code adds more.
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    found: list[Diagnostic] = []
    try:
        yield found
    finally:
        commentaries = (_decoded(attrgetter("commentary"), note) for note in delegate.TakeUncoalescedDiagnostics())
        found.extend(Diagnostic("openusd", _shorten(note), _prim_in(note)) for note in dict.fromkeys(commentaries))


@contextmanager
def _without_advice_errors() -> Iterator[None]:
    """Drop the line that OpenUSD prints for a corrupt crate, past its diagnostics; pass all else on to stderr."""
    try:
        said = tempfile.TemporaryFile()  # noqa: SIM115 - closed below, if stderr can be saved
        saved = os.dup(_STDERR)
    except OSError:
        # The process has no stderr, or no folder for temporary files.
        yield
        return
    with said:
        os.dup2(said.fileno(), _STDERR)
        try:
            yield
        finally:
            os.dup2(saved, _STDERR)
            os.close(saved)
            said.seek(0)
            os.write(_STDERR, b"".join(line for line in said if not line.startswith(_ADVICE_ERROR)))


def _decoded(get_text: Callable[[Any], str], message: Any) -> str:
    """Return the beginning of a message of OpenUSD, which may quote bytes that are not UTF-8."""
    try:
        # OpenUSD repeats a message for each part of a corrupt file, up to millions of lines.
        return get_text(message)[: LIMITS.max_openusd_text]
    except UnicodeDecodeError:
        return _NOT_UTF8


@contextmanager
def translated_errors(source: str) -> Iterator[None]:
    """Translate exceptions of OpenUSD to SceneError about the stage named `source`."""
    try:
        yield
    except UNREADABLE as error:
        raise SceneError(_cannot_open(source, error_text(error))) from error


def error_text(error: Exception) -> str:
    """Return the first message of an exception of OpenUSD on one line; may be empty."""
    return _NOT_UTF8 if isinstance(error, UnicodeDecodeError) else _shorten(_decoded(str, error))


def read_value(prim: Any, name: str, time: Usd.TimeCode, *types: type) -> Any:
    """Return an attribute's value at `time`; None if it is missing, unreadable, or of none of the types."""
    attribute = prim.GetAttribute(name)
    value = value_of(attribute, time) if attribute else None
    return value if isinstance(value, types) else None


def value_of(attribute: Any, time: Usd.TimeCode) -> Any:
    """Return the value of an attribute or shader input of any type; None if it cannot be read."""
    try:
        return attribute.Get(time)
    except UNREADABLE:
        return None


def read_targets(prim: Any, name: str) -> list[Any]:
    """Return the targets of a relationship; none if it is missing, unreadable, or authored as an attribute."""
    relationship = prim.GetRelationship(name)
    try:
        return list(relationship.GetTargets()) if relationship else []
    except UNREADABLE:
        return []


def time_code(time: float | None) -> Usd.TimeCode:
    """Return a time code; for None the earliest, at which attributes without time samples have their default value."""
    return Usd.TimeCode.EarliestTime() if time is None else Usd.TimeCode(time)


def _check_file(source: Path) -> SourceFormat | None:
    """Return the format of a file or folder that needs conversion; None for a USD file."""
    if not source.exists():
        raise SceneError(f"{source}: no such file; expected a scene ({', '.join(SCENE_ENDINGS)})")
    if source.is_dir():
        return _check_folder(source)
    if source.stat().st_size == 0:
        raise SceneError(f"{source}: the file is empty, expected a USD stage; export it again")
    found = find_format(source)
    if found is None:
        refuse_other_xml(source)
    if found is None and not Sdf.FileFormat.FindByExtension(str(source)):
        raise SceneError(
            f"{source}: not a USD file (ending {source.suffix or 'missing'!r}), expected one of "
            f"{', '.join(SCENE_ENDINGS)}; convert the scene to USD first"
        )
    return found


def _check_folder(source: Path) -> SourceFormat:
    found = find_format(source)
    if found is None:
        raise SceneError(
            f"{source}: is a folder without OBJ files, expected a USD stage; name the root layer inside it"
        )
    stages = stages_in(source)
    if stages:
        raise SceneError(
            f"{source}: is a folder with OBJ files and USD stages such as {stages[0].relative_to(source).as_posix()}; "
            f"name the stage, or make one of the OBJ files: usd2kg convert {source} -o FILE.usdc"
        )
    return found


def _cannot_open(source: str, reason: str) -> str:
    return f"{source}: OpenUSD cannot read this layer{f' ({reason})' if reason else ''}; export it again"


def _shorten(message: str) -> str:
    """Return the first message on one line, without locations in OpenUSD's source code."""
    texts = re.split(r"'?\s*Error in '[^']*' at line \d+ in file \S+ : '?", message.strip())
    first = next((text for text in texts if text.strip(" '")), "")
    line = " ".join(first.split()).removeprefix("Encountered: ").rstrip("'")
    limit = LIMITS.max_openusd_message
    return line if len(line) <= limit else line[: limit - 1] + "…"


def _composition_diagnostic(error: Any, stage: Any) -> Diagnostic:
    text = _decoded(str, error)
    # Only the text names the layer of the broken arc; the fields name the root layer.
    introduced_by = re.search(r"introduced by @([^@]+)@", text)
    layer = introduced_by.group(1) if introduced_by else stage.GetRootLayer().identifier
    return Diagnostic("composition", _shorten(text), str(error.rootSite.path), layer)


def _other_notes(notes: Iterable[Diagnostic], composition: Iterable[Diagnostic]) -> list[Diagnostic]:
    # OpenUSD repeats composition errors as warnings.
    known = [diagnostic.message.rstrip("…")[: LIMITS.same_message_length] for diagnostic in composition]
    return [note for note in notes if not any(message in note.message for message in known)]


def _prim_in(note: str) -> str | None:
    found = re.search(r"<(/[^>]*)>", note)
    return found.group(1) if found else None


def _read_frame(stage: Any, options: ReadOptions) -> tuple[StageFrame, list[Diagnostic]]:
    notes: list[Diagnostic] = []
    layer = stage.GetRootLayer().identifier
    metres = options.metres_per_unit or _metadata(stage, UsdGeom.Tokens.metersPerUnit)
    is_authored = _is_unit(metres)
    if metres is not None and not is_authored:
        notes.append(_odd_unit("metersPerUnit", metres, _USD_FALLBACK_METRES, layer))
    if metres is None:
        notes.append(_not_authored("metersPerUnit", "of 0.01 m is", "--metres-per-unit", stage))
    up_axis = options.up_axis or _metadata(stage, UsdGeom.Tokens.upAxis)
    if up_axis is not None and str(up_axis) not in {"Y", "Z"}:
        notes.append(Diagnostic("units", f"upAxis is {str(up_axis)!r}, expected Y or Z; Y is used", None, layer))
    if up_axis is None:
        notes.append(_not_authored("upAxis", "Y is", "--up-axis", stage))
    kilograms = _metadata(stage, "kilogramsPerUnit")
    has_kilograms = _is_unit(kilograms)
    if kilograms is not None and not has_kilograms:
        notes.append(_odd_unit("kilogramsPerUnit", kilograms, 1, layer))
    frame = StageFrame(
        up_axis="Z" if str(up_axis) == "Z" else "Y",
        metres_per_unit=_as_double(metres) if is_authored else _USD_FALLBACK_METRES,
        kilograms_per_unit=_as_double(kilograms) if has_kilograms else 1.0,
        is_authored=is_authored,
    )
    return frame, notes


def _not_authored(key: str, fallback: str, option: str, stage: Any) -> Diagnostic:
    """Return a diagnostic for stage metadata that the root layer lacks; OpenUSD does not read that of sublayers."""
    below = next((layer for layer in stage.GetLayerStack() if layer.pseudoRoot.HasInfo(key)), None)
    said = "" if below is None else f" (a sublayer says {below.pseudoRoot.GetInfo(key)}, which OpenUSD does not read)"
    message = f"{key} is not authored{said}; OpenUSD's fallback {fallback} used; author it, or set {option}"
    return Diagnostic("units", message, None, stage.GetRootLayer().identifier)


def _metadata(stage: Any, key: str) -> Any:
    # Not UsdGeom.GetStageMetersPerUnit, which raises if the authored type is not double.
    try:
        return stage.GetMetadata(key) if stage.HasAuthoredMetadata(key) else None
    except UNREADABLE as error:
        # Reported as the value found in place of a number.
        return error_text(error)


def _odd_unit(key: str, value: Any, used: float, layer: str) -> Diagnostic:
    expected = f"a number from {LIMITS.min_unit:g} to {LIMITS.max_unit:g}"
    message = f"{key} is {value!r}, expected {expected}; {used:g} is used"
    return Diagnostic("units", message, None, layer)


def _is_unit(value: Any) -> bool:
    return isinstance(value, int | float) and LIMITS.min_unit <= value <= LIMITS.max_unit


def _as_double(value: float) -> float:
    # Restore the decimal number of a 32-bit float, such as 0.01 for 0.00999999977.
    return float(f"{value:.7g}")


def _hash_layers(stage: Any) -> _StageContents:
    digests: list[str] = []
    files: dict[str, StageFile] = {}
    for layer in stage.GetUsedLayers():
        # `room.usdz[chair.usda]` is a layer in a package.
        name, _, inner = layer.realPath.partition("[")
        file = Path(name) if name else None
        if file is not None and file.is_file() and name not in files:
            # The state before the content: a later change then shows.
            state = file.stat()
            files[name] = StageFile(name, state.st_size, state.st_mtime_ns, hash_file(file))
        if name in files and not inner and not layer.dirty:
            digests.append(files[name].sha256)
        elif not layer.empty:
            # Layers edited in memory differ from their files.
            digests.append(hashlib.sha256(layer.ExportToString().encode()).hexdigest())
    digest = hashlib.sha256("".join(sorted(digests)).encode()).hexdigest()
    return _StageContents(f"sha256:{digest}", tuple(files[name] for name in sorted(files)))
