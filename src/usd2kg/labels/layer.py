"""write_labels: a layer over a stage, in which prims carry the labels of their classes."""

import os
import re
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, Usd

from usd2kg.errors import OutputError
from usd2kg.files import check_writable, is_same_file, write_whole
from usd2kg.labels.model import ClassLabel, LabelOptions, LabelOutcome, LabelReport
from usd2kg.labels.opinions import LabelOpinions, plan_opinions
from usd2kg.labels.targets import LabelTarget, find_target
from usd2kg.scene.label_encodings import TAG_LABELS, semantic_names
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import captured_diagnostics, open_stage, translated_errors

__all__ = ["write_labels"]

_ENDINGS = (".usda", ".usdc", ".usd")
_MARK = "usd2kg"
"""Key of `customLayerData` by which a layer of labels is known again."""
_NOT_CARRIED_OVER = frozenset(
    "comment documentation layerRelocates primChildren primOrder subLayerOffsets subLayers".split()
)
"""Metadata of a root layer that composes by itself, or that is of the layer alone."""


def write_labels(
    source: Path | str | Usd.Stage,
    labels: Mapping[str, ClassLabel],
    output: Path | str,
    options: LabelOptions | None = None,
) -> LabelReport:
    """Write a layer that labels prims, and return what became of each label. The source is never changed.

    Unless it is bare, the layer is a root layer over the source: it names it as a sublayer, by a relative path, and
    restates its metadata (units, axes, times, default prim), which OpenUSD takes from root layers alone.

    Args:
        source: the stage's root layer, or a stage that is open already, with its session layer as it stands.
        labels: prim path → its class.
        output: the file to write, .usda, .usdc or .usd.
        options: how; by default in OpenUSD's own encoding, prims without labels only.

    Raises:
        SceneError: the stage cannot be read.
        OutputError: the layer cannot be written there, is one of those that the stage is made of, or would replace a
            file that is no layer of labels of ours.
    """
    chosen, target = options or LabelOptions(), Path(output)
    if target.suffix.lower() not in _ENDINGS:
        raise OutputError(f"{target}: a layer of labels ends in one of {', '.join(_ENDINGS)}; choose such a name")
    check_writable(target)
    opened = open_stage(source, ReadOptions())
    with translated_errors(opened.source), captured_diagnostics():
        _refuse_source(opened.stage, target)
        layer = Sdf.Layer.CreateAnonymous(target.name)
        if not chosen.is_bare:
            _put_over(layer, opened.stage.GetRootLayer(), target)
        layer.customLayerData = {**layer.customLayerData, _MARK: {"content": "labels", **chosen.provenance}}
        report = _label_prims(opened.stage, labels, layer, chosen)
        data = _serialize(layer, target.suffix.lower())
    write_whole(target, data)
    return report


def _refuse_source(stage: Any, target: Path) -> None:
    for layer in stage.GetUsedLayers():
        if layer.realPath and is_same_file(Path(layer.realPath), target):
            raise OutputError(f"{target}: the stage is made of this layer, which is never changed; choose another name")
    # A variant that is not selected, or a payload that is not loaded, may need a layer that the stage does not use now.
    if target.is_file() and target.stat().st_size and not _is_of_labels(target):
        raise OutputError(f"{target}: exists and is no layer of labels of usd2kg, so it stays; choose another name")


def _is_of_labels(path: Path) -> bool:
    """Return whether a file is a layer that `write_labels` wrote, to which nobody added prims of another type."""
    try:
        layer = Sdf.Layer.OpenAsAnonymous(str(path))
    except Tf.ErrorException:
        return False
    if layer is None or _MARK not in layer.customLayerData:
        return False
    typed: list[Any] = []
    # A flattened stage keeps the mark and holds the whole scene.
    layer.Traverse(
        Sdf.Path.absoluteRootPath,
        lambda at: typed.append(at) if at.IsPrimPath() and layer.GetPrimAtPath(at).typeName else None,
    )
    return not typed


def _put_over(layer: Any, source: Any, target: Path) -> None:
    """Make `layer` a root layer over `source`, as it lies seen from `target`."""
    if source.anonymous:
        raise OutputError(f"{target}: the stage is in memory alone, so nothing can lie over it; save it, or write bare")
    folder = target.resolve().parent
    root = layer.pseudoRoot
    for key in source.pseudoRoot.ListInfoKeys():
        if key not in _NOT_CARRIED_OVER:
            root.SetInfo(key, _moved(source.pseudoRoot.GetInfo(key), source, folder))
    layer.documentation = f"Semantic labels over {Path(source.realPath or source.identifier).name}, by usd2kg."
    layer.subLayerPaths.append(_seen_from(folder, source.realPath or source.identifier))


def _moved(value: Any, source: Any, folder: Path) -> Any:
    """Return a metadata value; a relative asset path as it is seen from `folder`."""
    if isinstance(value, Sdf.AssetPath) and value.path.startswith("."):
        return Sdf.AssetPath(_seen_from(folder, source.ComputeAbsolutePath(value.path)))
    return value


def _seen_from(folder: Path, file: str) -> str:
    if not Path(file).exists():
        # What is behind a resolver, or in a package, has no place in the file system.
        return file
    relative = Path(os.path.relpath(Path(file).resolve(), folder)).as_posix()
    return relative if relative.startswith(".") else f"./{relative}"


def _label_prims(stage: Any, labels: Mapping[str, ClassLabel], layer: Any, options: LabelOptions) -> LabelReport:
    outcomes: list[LabelOutcome] = []
    de_instanced: set[str] = set()
    author = _Author(stage, layer, options)
    with Sdf.ChangeBlock():
        # Parents come before children.
        for path in sorted(labels, key=lambda path: path.split("/")):
            carrier = find_target(stage, path, de_instances=options.de_instances)
            if carrier.prim is None:
                outcomes.append(LabelOutcome(path, "left out", carrier.reason))
                continue
            opinions = author.label(carrier, path, labels[path])
            outcomes.append(LabelOutcome(path, opinions.outcome, opinions.reason))
            if opinions.outcome != "kept":
                de_instanced.update(carrier.instances)
        author.classes.author()
    return LabelReport(tuple(outcomes), tuple(sorted(de_instanced)))


class _Author:
    """Writes the labels of prims into a layer. On prims without any they are alike for each class: these are copied."""

    def __init__(self, stage: Any, layer: Any, options: LabelOptions) -> None:
        self.classes = _ClassPrims(stage, layer)
        self._layer = layer
        self._options = options
        self._time = Usd.TimeCode.EarliestTime()
        self._patterns = Sdf.Layer.CreateAnonymous()
        self._known: dict[str, tuple[LabelOpinions, str]] = {}
        """IRI of a class → what is said on prims without labels, and where the pattern of that is."""

    def label(self, carrier: LabelTarget, path: str, label: ClassLabel) -> LabelOpinions:
        """Write the label of the prim at `path`, and return what was written."""
        # What a mode removes differs from prim to prim.
        if self._options.mode != "overwrite" and not semantic_names(carrier.prim):
            if label.iri not in self._known:
                pattern = f"/Pattern_{len(self._known)}"
                opinions = plan_opinions(carrier.prim, label, self._options, self._time)
                self._write(Sdf.CreatePrimInLayer(self._patterns, pattern), opinions, label)
                self._known[label.iri] = opinions, pattern
            opinions, pattern = self._known[label.iri]
            self._break_up(carrier)
            if self._layer.GetPrimAtPath(path) is None:
                Sdf.CreatePrimInLayer(self._layer, path)
                Sdf.CopySpec(self._patterns, pattern, self._layer, path)
                return opinions
        else:
            opinions = plan_opinions(carrier.prim, label, self._options, self._time)
        if opinions.outcome != "kept":
            self._break_up(carrier)
            self._write(Sdf.CreatePrimInLayer(self._layer, path), opinions, label)
        return opinions

    def _break_up(self, carrier: LabelTarget) -> None:
        for instance in carrier.instances:
            Sdf.CreatePrimInLayer(self._layer, instance).instanceable = False

    def _write(self, spec: Any, opinions: LabelOpinions, label: ClassLabel) -> None:
        _author(spec, opinions, self.classes.path_of(label) if opinions.is_tagged else None)


def _author(spec: Any, opinions: LabelOpinions, class_prim: str | None) -> None:
    operation = Sdf.TokenListOp()
    operation.prependedItems = opinions.applied
    operation.deletedItems = opinions.removed
    spec.SetInfo("apiSchemas", operation)
    for name, tokens in opinions.tokens.items():
        Sdf.AttributeSpec(spec, name, Sdf.ValueTypeNames.TokenArray).default = list(tokens)
    for name, text in opinions.texts.items():
        Sdf.AttributeSpec(spec, name, Sdf.ValueTypeNames.String).default = text
    if class_prim is not None:
        _point(spec, TAG_LABELS, [class_prim])
    for name, told in opinions.blocked.items():
        if told:
            value_type = Sdf.ValueTypeNames.Find(told) or Sdf.ValueTypeNames.String
            Sdf.AttributeSpec(spec, name, value_type).default = Sdf.ValueBlock()
        else:
            _point(spec, name, [])


def _point(spec: Any, name: str, targets: list[str]) -> None:
    paths = Sdf.RelationshipSpec(spec, name, custom=False).targetPathList
    paths.ClearEditsAndMakeExplicit()
    paths.explicitItems = targets


class _ClassPrims:
    """The class prims that Multiverse's tags point to: `/<ontology>/_class_<name>`, those on the stage reused."""

    def __init__(self, stage: Any, layer: Any) -> None:
        self._stage = stage
        self._layer = layer
        self._roots: dict[str, str] = {}
        self._paths: dict[str, str] = {}
        self._new: dict[str, ClassLabel] = {}

    def path_of(self, label: ClassLabel) -> str:
        """Return the path of the prim of a class."""
        if label.iri not in self._paths:
            root = self._root(label.namespace)
            stem = f"{root}/_class_{_identifier(re.sub(r'[^0-9A-Za-z_]', '', label.concept) or label.concept)}"
            path = next(path for path in _numbered(stem) if self._is_free(path, label))
            self._paths[label.iri] = path
            if not self._stage.GetPrimAtPath(path):
                self._new[path] = label
        return self._paths[label.iri]

    def _root(self, namespace: str) -> str:
        if namespace not in self._roots:
            name = re.split(r"[/:]", namespace.rstrip("#/:"))[-1]
            stem = "/" + _identifier(re.sub(r"\.(owl|ttl|rdf|ofn)$", "", name) or "Ontology")
            taken = set(self._roots.values())
            self._roots[namespace] = next(
                path for path in _numbered(stem) if path not in taken and self._is_scope(path)
            )
        return self._roots[namespace]

    def _is_scope(self, path: str) -> bool:
        prim = self._stage.GetPrimAtPath(path)
        return not prim or not prim.GetTypeName()

    def _is_free(self, path: str, label: ClassLabel) -> bool:
        """Return whether a path holds nothing yet, or the prim of this very class."""
        if path in self._new:
            return False
        prim = self._stage.GetPrimAtPath(path)
        if not prim:
            return True
        told = [prim.GetAttribute(name).Get() for name in ("rdf:namespace", "rdf:conceptName")]
        return told == [label.namespace, label.concept]

    def author(self) -> None:
        """Write the prims of the classes that are not on the stage."""
        for path, label in sorted(self._new.items()):
            spec = Sdf.CreatePrimInLayer(self._layer, path)
            parent = spec.nameParent
            parent.specifier, spec.specifier = Sdf.SpecifierDef, Sdf.SpecifierClass
            operation = Sdf.TokenListOp()
            operation.prependedItems = ["RdfAPI"]
            spec.SetInfo("apiSchemas", operation)
            told = {"conceptName": label.concept, "definition": label.definition, "namespace": label.namespace}
            for name, text in told.items():
                if text:
                    Sdf.AttributeSpec(spec, f"rdf:{name}", Sdf.ValueTypeNames.String).default = text


def _identifier(name: str) -> str:
    return str(Tf.MakeValidIdentifier(name))


def _numbered(stem: str) -> Iterator[str]:
    yield stem
    number = 2
    while True:
        yield f"{stem}_{number}"
        number += 1


def _serialize(layer: Any, ending: str) -> bytes:
    if ending == ".usda":
        return str(layer.ExportToString()).encode()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"labels{ending}"
        layer.Export(str(path))
        return path.read_bytes()
