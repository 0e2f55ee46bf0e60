"""author_labels: the opinions that label prims, in any layer."""

from collections.abc import Mapping
from typing import Any

from pxr import Sdf, Usd

from usd2kg.labels.class_prims import ClassPrims
from usd2kg.labels.model import ClassLabel, LabelOptions, LabelOutcome, LabelReport
from usd2kg.labels.opinions import LabelOpinions, plan_opinions
from usd2kg.labels.targets import LabelTarget, find_target
from usd2kg.ontology import ClassIRI
from usd2kg.scene.label_encodings import PREDICTION_KEY, TAG_LABELS, semantic_names

__all__ = ["author_labels"]


def author_labels(
    stage: Usd.Stage, labels: Mapping[str, ClassLabel], layer: Sdf.Layer, options: LabelOptions
) -> LabelReport:
    """Author labels in a layer, and return the outcome for each prim.

    Args:
        stage: the composed stage; existing labels are read from it.
        labels: prim path → class.
        layer: the layer for the opinions. It must not be part of the stage, which is read between the edits.
        options: encodings and mode.
    """
    outcomes: list[LabelOutcome] = []
    de_instanced: set[str] = set()
    author = _LabelAuthor(stage, layer, options)
    with Sdf.ChangeBlock():
        # Parents before children: Sdf.CopySpec in `author_label` would replace children.
        for path in sorted(labels, key=lambda path: path.split("/")):
            target = find_target(stage, path, de_instances=options.de_instances)
            if target.prim is None:
                outcomes.append(LabelOutcome(path, "left out", target.reason))
                continue
            opinions = author.author_label(target, path, labels[path])
            outcomes.append(LabelOutcome(path, opinions.outcome, opinions.reason))
            if opinions.outcome != "kept":
                de_instanced.update(target.instances)
                author.state_confidence(target, path, labels[path])
        author.class_prims.author()
    return LabelReport(tuple(outcomes), tuple(sorted(de_instanced)))


class _LabelAuthor:
    """Authors labels in a layer. Specs of unlabelled prims depend only on the label and are copied from templates."""

    def __init__(self, stage: Any, layer: Any, options: LabelOptions) -> None:
        self.class_prims = ClassPrims(stage, layer)
        self._layer = layer
        self._options = options
        self._time = Usd.TimeCode.EarliestTime()
        self._templates = Sdf.Layer.CreateAnonymous()
        self._cached: dict[tuple[ClassIRI, str], tuple[LabelOpinions, str]] = {}
        """(class, concept) → the opinions on a prim without labels, and the path of their template."""

    def author_label(self, target: LabelTarget, path: str, label: ClassLabel) -> LabelOpinions:
        """Author the label of the prim at `path`, and return its opinions."""
        is_labelled = bool(semantic_names(target.prim))
        # Mode `overwrite` deletes applied schemas, which can differ even between prims without labels.
        if not is_labelled and self._options.mode != "overwrite":
            return self._copy_template(target, path, label)
        opinions = plan_opinions(target.prim, label, self._options, self._time)
        if opinions.outcome != "kept":
            self._make_uninstanceable(target)
            self._author(Sdf.CreatePrimInLayer(self._layer, path), opinions, label)
        return opinions

    def state_confidence(self, target: LabelTarget, path: str, label: ClassLabel) -> None:
        """State how certain a prediction is, so that reading it again makes it no more certain."""
        if label.confidence is not None:
            stated = {"confidence": label.confidence, "label": label.token}
        elif target.prim.GetCustomDataByKey(PREDICTION_KEY) is not None:
            # An earlier layer states the confidence of a label that may be this one; OpenUSD merges dictionaries.
            stated = {"label": ""}
        else:
            return
        spec = self._layer.GetPrimAtPath(path)
        spec.customData = {**spec.customData, PREDICTION_KEY: stated}

    def _copy_template(self, target: LabelTarget, path: str, label: ClassLabel) -> LabelOpinions:
        key = label.iri, label.concept
        if key not in self._cached:
            template = f"/Template_{len(self._cached)}"
            opinions = plan_opinions(target.prim, label, self._options, self._time)
            self._author(Sdf.CreatePrimInLayer(self._templates, template), opinions, label)
            self._cached[key] = opinions, template
        opinions, template = self._cached[key]
        self._make_uninstanceable(target)
        if self._layer.GetPrimAtPath(path) is None:
            Sdf.CreatePrimInLayer(self._layer, path)
            Sdf.CopySpec(self._templates, template, self._layer, path)
        else:
            self._author(Sdf.CreatePrimInLayer(self._layer, path), opinions, label)
        return opinions

    def _make_uninstanceable(self, target: LabelTarget) -> None:
        for instance in target.instances:
            Sdf.CreatePrimInLayer(self._layer, instance).instanceable = False

    def _author(self, spec: Any, opinions: LabelOpinions, label: ClassLabel) -> None:
        _author_opinions(spec, opinions, self.class_prims.path_of(label) if opinions.is_tagged else None)


def _author_opinions(spec: Any, opinions: LabelOpinions, class_prim: str | None) -> None:
    schemas = Sdf.TokenListOp()
    schemas.prependedItems = opinions.applied
    schemas.deletedItems = opinions.removed
    spec.SetInfo("apiSchemas", schemas)
    for name, tokens in opinions.tokens.items():
        Sdf.AttributeSpec(spec, name, Sdf.ValueTypeNames.TokenArray).default = list(tokens)
    for name, text in opinions.texts.items():
        Sdf.AttributeSpec(spec, name, Sdf.ValueTypeNames.String).default = text
    if class_prim is not None:
        _set_targets(spec, TAG_LABELS, [class_prim])
    for name, type_name in opinions.blocked.items():
        if type_name:
            value_type = Sdf.ValueTypeNames.Find(type_name) or Sdf.ValueTypeNames.String
            Sdf.AttributeSpec(spec, name, value_type).default = Sdf.ValueBlock()
        else:
            _set_targets(spec, name, [])


def _set_targets(spec: Any, name: str, targets: list[str]) -> None:
    paths = Sdf.RelationshipSpec(spec, name, custom=False).targetPathList
    paths.ClearEditsAndMakeExplicit()
    paths.explicitItems = targets
