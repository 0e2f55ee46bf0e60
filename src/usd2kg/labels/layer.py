"""write_labels: a layer over a stage that labels its prims."""

import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, Usd

from usd2kg.convert import LAYER_ENDINGS
from usd2kg.errors import OutputError
from usd2kg.files import check_writable, is_same_file, write_whole
from usd2kg.labels.author import author_labels
from usd2kg.labels.model import ClassLabel, LabelOptions, LabelReport
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.session_layer import is_marked, mark_layer, provenance_of
from usd2kg.scene.stage import captured_diagnostics, open_stage, translated_errors

__all__ = ["ontologies_of_labels", "write_labels"]

_NOT_COPIED = frozenset("comment documentation layerRelocates primChildren primOrder subLayerOffsets subLayers".split())
"""Metadata of a root layer that OpenUSD composes from its sublayers, or that describes only that layer."""


def write_labels(
    source: Path | str | Usd.Stage,
    labels: Mapping[str, ClassLabel],
    output: Path | str,
    options: LabelOptions | None = None,
) -> LabelReport:
    """Write a layer that labels prims, and return the outcome for each prim. The source is not modified.

    Unless it is bare, the layer is a root layer: it has the source as a sublayer, by a relative path, and copies its
    stage metadata (units, up axis, time codes, default prim), which OpenUSD reads only from the root layer.

    Args:
        source: the stage's root layer, or an open stage, whose session layer is respected.
        labels: prim path → class.
        output: the file to write, `.usda`, `.usdc` or `.usd`.
        options: by default, OpenUSD's encoding on prims without labels.

    Raises:
        SceneError: the stage cannot be read.
        OutputError: the layer cannot be written, belongs to the stage, or would replace a file that is not a label
            layer of usd2kg.
    """
    chosen, target = options or LabelOptions(), Path(output)
    if target.suffix.lower() not in LAYER_ENDINGS:
        raise OutputError(f"{target}: expected a label layer with a name ending in one of {', '.join(LAYER_ENDINGS)}")
    check_writable(target)
    opened = open_stage(source, ReadOptions())
    with translated_errors(opened.source), captured_diagnostics():
        _check_replaceable(opened.stage, target)
        layer = Sdf.Layer.CreateAnonymous(target.name)
        if not chosen.is_bare:
            _place_over(layer, opened.stage.GetRootLayer(), target)
        mark_layer(layer, "labels", chosen.provenance)
        report = author_labels(opened.stage, labels, layer, chosen)
        data = _serialize(layer, target.suffix.lower())
    write_whole(target, data)
    return report


def ontologies_of_labels(source: Path | str) -> set[str]:
    """Return the IRIs of the ontologies that the label layers of a stage name.

    Raises:
        SceneError: the stage cannot be read.
    """
    opened = open_stage(source, ReadOptions())
    stated = (provenance_of(layer, "labels").get("ontology") for layer in opened.stage.GetUsedLayers())
    return {iri for iri in stated if iri}


def _check_replaceable(stage: Any, target: Path) -> None:
    for layer in stage.GetUsedLayers():
        if layer.realPath and is_same_file(Path(layer.realPath), target):
            raise OutputError(f"{target}: is a layer of the stage, which is never modified; choose another name")
    # The stage may refer to further files through an unselected variant or an unloaded payload.
    if target.is_file() and target.stat().st_size and not _is_label_layer(target):
        raise OutputError(f"{target}: exists and is not a label layer of usd2kg; choose another name")


def _is_label_layer(path: Path) -> bool:
    """Return whether a file is a layer that `write_labels` wrote, without typed prims added since."""
    try:
        layer = Sdf.Layer.OpenAsAnonymous(str(path))
    except Tf.ErrorException:
        return False
    if layer is None or not is_marked(layer):
        return False
    typed: list[Any] = []
    # A flattened stage keeps the mark but contains the whole scene.
    layer.Traverse(
        Sdf.Path.absoluteRootPath,
        lambda at: typed.append(at) if at.IsPrimPath() and layer.GetPrimAtPath(at).typeName else None,
    )
    return not typed


def _place_over(layer: Any, source: Any, target: Path) -> None:
    """Make `layer`, to be saved at `target`, a root layer over `source`."""
    if source.anonymous:
        raise OutputError(
            f"{target}: the stage exists only in memory, so no layer can refer to it; save it (convert a file of "
            "another format with usd2kg convert), or write a bare layer"
        )
    folder = target.resolve().parent
    root = layer.pseudoRoot
    for key in source.pseudoRoot.ListInfoKeys():
        if key not in _NOT_COPIED:
            root.SetInfo(key, _relocate(source.pseudoRoot.GetInfo(key), source, folder))
    layer.documentation = f"Semantic labels over {Path(source.realPath or source.identifier).name}, by usd2kg."
    layer.subLayerPaths.append(_path_from(folder, source.realPath or source.identifier))


def _relocate(value: Any, source: Any, folder: Path) -> Any:
    """Return a metadata value with a relative asset path made relative to `folder`."""
    if isinstance(value, Sdf.AssetPath) and value.path.startswith("."):
        return Sdf.AssetPath(_path_from(folder, source.ComputeAbsolutePath(value.path)))
    return value


def _path_from(folder: Path, file: str) -> str:
    if not Path(file).exists():
        # Resolver URIs and files inside packages have no file system path.
        return file
    relative = Path(os.path.relpath(Path(file).resolve(), folder)).as_posix()
    return relative if relative.startswith(".") else f"./{relative}"


def _serialize(layer: Any, ending: str) -> bytes:
    if ending == ".usda":
        return str(layer.ExportToString()).encode()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"labels{ending}"
        layer.Export(str(path))
        return path.read_bytes()
