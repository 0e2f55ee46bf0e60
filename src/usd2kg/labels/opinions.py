"""plan_opinions: the opinions that label a prim, as a plan that authors nothing."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from usd2kg.labels.model import ClassLabel, LabelOptions, Outcome
from usd2kg.scene.label_encodings import (
    CLASS_TAXONOMIES,
    CONCEPT_TAXONOMY,
    TAG_LABELS,
    TAG_SCHEMA,
    USD_PREFIX,
    LabelProperty,
    applied_schemas,
    class_words,
    clean_values,
    find_labels,
    isaac_instance,
    isaac_property,
    isaac_schema,
    property_type,
    schema_of,
    semantic_names,
    usd_schema,
)
from usd2kg.scene.label_lint import meant_property, quote_labels
from usd2kg.scene.model import Encoding

__all__ = ["LabelOpinions", "plan_opinions"]

_ISAAC_CLASS = "Semantics"
"""The schema instance that Isaac's own functions use for the class of a prim."""


@dataclass
class LabelOpinions:
    """The opinions on one prim."""

    outcome: Outcome
    reason: str = ""
    tokens: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Property → labels, in OpenUSD's encoding."""
    texts: dict[str, str] = field(default_factory=dict)
    """Property → text, in Isaac's encoding."""
    is_tagged: bool = False
    """Whether Multiverse's tag points to the class prim, and to no other prim."""
    blocked: dict[str, str] = field(default_factory=dict)
    """Property whose value is blocked → its value type; empty for a relationship."""
    applied: list[str] = field(default_factory=list)
    """API schemas to prepend."""
    removed: list[str] = field(default_factory=list)
    """API schemas to delete."""


def plan_opinions(prim: Any, label: ClassLabel, options: LabelOptions, time: Any) -> LabelOpinions:
    """Return the opinions that label `prim`, given its existing labels and the mode."""
    names = semantic_names(prim)
    found = find_labels(prim, names, time) if names else []
    labels = [entry for entry in found if entry.strength == "label" and any(entry.values)]
    if options.mode == "new" and labels:
        return LabelOpinions("kept", f"has labels already: {_quote(labels)}")
    if options.mode == "overwrite":
        misspelt = _misspelt_class_properties(prim, names, time)
        replaced = [entry for entry in found if entry.states_class or entry.taxonomy == CONCEPT_TAXONOMY]
        return _replace(prim, label, options, replaced, misspelt)
    classes = [entry for entry in labels if entry.states_class]
    if classes and not _name_class(classes, label):
        return LabelOpinions("kept", f"its labels name another class: {_quote(classes)}")
    return _complete(label, options, labels)


def _quote(labels: Iterable[LabelProperty]) -> str:
    return quote_labels([value for entry in labels for value in entry.values if value])


def _name_class(classes: Iterable[LabelProperty], label: ClassLabel) -> bool:
    """Return whether existing labels may name a class: by its IRI, or else a Wikidata item or a word of its names."""
    words = {word for name in (label.token, label.local_name, *label.names) for word in class_words(name)}
    values = {value for entry in classes for value in entry.values if value}
    iris = {value for entry in classes if entry.taxonomy == "iri" for value in entry.values}
    if iris:
        return label.iri in iris
    return any(value in label.qcodes or not class_words(value).isdisjoint(words) for value in values)


def _complete(label: ClassLabel, options: LabelOptions, labels: list[LabelProperty]) -> LabelOpinions:
    """Return the opinions for the encodings and taxonomies in which a prim has no label."""
    present = {(entry.encoding, entry.taxonomy) for entry in labels}
    opinions = LabelOpinions("completed" if labels else "written")
    taken = {instance for entry in labels if (instance := isaac_instance(entry.property_name))}
    _add_label(opinions, label, options.encodings, taken, present)
    if not opinions.applied:
        return LabelOpinions("kept", f"has all of these labels already: {_quote(labels)}")
    return opinions


def _misspelt_class_properties(prim: Any, names: Iterable[str], time: Any) -> set[str]:
    """Return the properties that look like misspelt class labels, which no tool reads."""
    intended = {name: meant_property(name) or name for name in names}
    class_instances = {
        instance
        for name, wanted in intended.items()
        if (instance := isaac_instance(wanted)) and wanted == isaac_property(instance, "Type")
        if not CLASS_TAXONOMIES.isdisjoint(clean_values(prim, name, time))
    }
    return {
        name
        for name, wanted in intended.items()
        if wanted != name
        if wanted == TAG_LABELS
        or wanted.removeprefix(USD_PREFIX).lower() in CLASS_TAXONOMIES
        or isaac_instance(wanted) in class_instances
    }


def _replace(
    prim: Any, label: ClassLabel, options: LabelOptions, classes: list[LabelProperty], misspelt: set[str]
) -> LabelOpinions:
    """Return the opinions that replace all class labels and keep the labels of other taxonomies."""
    opinions = LabelOpinions("replaced" if misspelt or any(any(entry.values) for entry in classes) else "written")
    old = {name for entry in classes for name in _properties_of(entry)} | misspelt
    kept = {name for name in semantic_names(prim) if name not in old}
    taken = {instance for name in kept if (instance := isaac_instance(name))}
    _add_label(opinions, label, options.encodings, taken)
    new = {*opinions.tokens, *opinions.texts, *([TAG_LABELS] if opinions.is_tagged else [])}
    opinions.blocked = {name: property_type(prim, name) for name in sorted(old - new) if prim.HasProperty(name)}
    used = {schema_of(name) for name in (*kept, *new)}
    opinions.removed = [schema for schema in applied_schemas(prim) if schema not in used]
    return opinions


def _properties_of(entry: LabelProperty) -> Iterator[str]:
    instance = isaac_instance(entry.property_name)
    if instance is None:
        yield entry.property_name
    else:
        yield from (isaac_property(instance, half) for half in ("Type", "Data"))


def _add_label(
    opinions: LabelOpinions,
    label: ClassLabel,
    encodings: Iterable[Encoding],
    taken: set[str],
    present: Iterable[tuple[Encoding, str]] = (),
) -> None:
    """Add `label` in each encoding and taxonomy.

    Args:
        opinions: modified in place.
        label: the class.
        encodings: the encodings to write.
        taken: names of Isaac's schema instances that hold other labels.
        present: encodings and taxonomies that have labels already and are skipped.
    """
    if "UsdSemantics" in encodings:
        for taxonomy, values in _usd_labels(label).items():
            if ("UsdSemantics", taxonomy) not in present:
                opinions.tokens[USD_PREFIX + taxonomy] = values
                opinions.applied.append(usd_schema(taxonomy))
    if "Isaac" in encodings:
        for taxonomy, text in _isaac_labels(label).items():
            if ("Isaac", taxonomy) not in present:
                instance = _free_instance(taxonomy, taken)
                opinions.texts[isaac_property(instance, "Type")] = taxonomy
                opinions.texts[isaac_property(instance, "Data")] = text
                opinions.applied.append(isaac_schema(instance))
    if "Multiverse" in encodings and not any(encoding == "Multiverse" for encoding, _ in present):
        opinions.is_tagged = True
        opinions.applied.append(TAG_SCHEMA)


def _usd_labels(label: ClassLabel) -> Mapping[str, tuple[str, ...]]:
    """Return taxonomy → labels."""
    labels = {"class": (*label.ancestors, label.token), "iri": (label.iri,), "wikidata_qcode": label.qcodes}
    if label.concept:
        labels[CONCEPT_TAXONOMY] = (label.concept,)
    return {taxonomy: values for taxonomy, values in labels.items() if values}


def _isaac_labels(label: ClassLabel) -> Mapping[str, str]:
    """Return taxonomy → text. Isaac has one text per taxonomy, so superclasses become a path in `hierarchy`."""
    labels = {"class": label.token, "iri": label.iri}
    if label.qcodes:
        labels["qcode"] = label.qcodes[0]
    if label.ancestors:
        labels["hierarchy"] = "/".join((*label.ancestors, label.token))
    if label.concept:
        labels[CONCEPT_TAXONOMY] = label.concept
    return labels


def _free_instance(taxonomy: str, taken: set[str]) -> str:
    names = [_ISAAC_CLASS] if taxonomy == "class" else []
    names += [f"{_ISAAC_CLASS}_{taxonomy}{suffix}" for suffix in ("", *(f"_{n}" for n in range(2, len(taken) + 3)))]
    return next(name for name in names if name not in taken)
