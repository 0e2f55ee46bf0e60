"""Which opinions a layer needs on one prim, so that its labels say a class: plain records, nothing is authored here."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from usd2kg.labels.model import ClassLabel, LabelOptions, Outcome
from usd2kg.scene.label_encodings import (
    CLASS_TAXONOMIES,
    TAG_LABELS,
    TAG_SCHEMA,
    USD,
    Found,
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
"""The instance that Isaac's own functions write a prim's class to."""


@dataclass
class LabelOpinions:
    """What a layer is to say about the labels of one prim."""

    outcome: Outcome
    reason: str = ""
    tokens: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Property → labels, of OpenUSD's encoding."""
    texts: dict[str, str] = field(default_factory=dict)
    """Property → text, of Isaac's."""
    is_tagged: bool = False
    """Whether the prim is to point to its class prim, and to no other."""
    blocked: dict[str, str] = field(default_factory=dict)
    """Property that is to say nothing any more → its value type, empty for a relationship."""
    applied: list[str] = field(default_factory=list)
    """Schemas to apply."""
    removed: list[str] = field(default_factory=list)
    """Schemas to take away."""


def plan_opinions(prim: Any, label: ClassLabel, options: LabelOptions, time: Any) -> LabelOpinions:
    """Return what a layer is to say on `prim`, by what stands there already and by the mode."""
    names = semantic_names(prim)
    found = find_labels(prim, names, time) if names else []
    labels = [entry for entry in found if entry.strength == "label" and any(entry.values)]
    if options.mode == "new" and labels:
        return LabelOpinions("kept", f"has labels already: {_told(labels)}")
    if options.mode == "overwrite":
        misspelt = _misspelt_classes(prim, names, time)
        return _replace(prim, label, options, [entry for entry in found if entry.tells_class], misspelt)
    classes = [entry for entry in labels if entry.tells_class]
    if classes and not _means(classes, label):
        return LabelOpinions("kept", f"its labels say another class: {_told(classes)}")
    return _complete(label, options, labels)


def _told(labels: Iterable[Found]) -> str:
    return quote_labels([value for entry in labels for value in entry.values if value])


def _means(classes: Iterable[Found], label: ClassLabel) -> bool:
    """Return whether labels may mean the class: one of them is its IRI, an item of it, or shares a word with it."""
    words = {word for name in (label.token, label.concept, *label.names) for word in class_words(name)}
    values = {value for entry in classes for value in entry.values if value}
    iris = {value for entry in classes if entry.taxonomy == "iri" for value in entry.values}
    if iris:
        return label.iri in iris
    return any(value in label.qcodes or not class_words(value).isdisjoint(words) for value in values)


def _complete(label: ClassLabel, options: LabelOptions, labels: list[Found]) -> LabelOpinions:
    """Return the opinions for the encodings and taxonomies that a prim has no label in."""
    known = {(entry.encoding, entry.taxonomy) for entry in labels}
    opinions = LabelOpinions("completed" if labels else "written")
    taken = {instance for entry in labels if (instance := isaac_instance(entry.property_name))}
    _add(opinions, label, options.encodings, taken, known)
    if not opinions.applied:
        return LabelOpinions("kept", f"has all of these labels already: {_told(labels)}")
    return opinions


def _misspelt_classes(prim: Any, names: Iterable[str], time: Any) -> set[str]:
    """Return the properties that were meant to say a class, under names that no tool reads."""
    meant = {name: meant_property(name) or name for name in names}
    types = {
        instance
        for name, wanted in meant.items()
        if (instance := isaac_instance(wanted)) and wanted == isaac_property(instance, "Type")
        if not CLASS_TAXONOMIES.isdisjoint(clean_values(prim, name, time))
    }
    return {
        name
        for name, wanted in meant.items()
        if wanted != name
        if wanted == TAG_LABELS
        or wanted.removeprefix(USD).lower() in CLASS_TAXONOMIES
        or isaac_instance(wanted) in types
    }


def _replace(
    prim: Any, label: ClassLabel, options: LabelOptions, classes: list[Found], misspelt: set[str]
) -> LabelOpinions:
    """Return the opinions that leave no other label of a class, and labels of other taxonomies as they are."""
    opinions = LabelOpinions("replaced" if misspelt or any(any(entry.values) for entry in classes) else "written")
    old = {name for entry in classes for name in _properties(entry)} | misspelt
    kept = {name for name in semantic_names(prim) if name not in old}
    taken = {instance for name in kept if (instance := isaac_instance(name))}
    _add(opinions, label, options.encodings, taken)
    said = {*opinions.tokens, *opinions.texts, *([TAG_LABELS] if opinions.is_tagged else [])}
    opinions.blocked = {name: property_type(prim, name) for name in sorted(old - said) if prim.HasProperty(name)}
    used = {schema_of(name) for name in (*kept, *said)}
    opinions.removed = [schema for schema in applied_schemas(prim) if schema not in used]
    return opinions


def _properties(entry: Found) -> Iterator[str]:
    instance = isaac_instance(entry.property_name)
    if instance is None:
        yield entry.property_name
    else:
        yield from (isaac_property(instance, half) for half in ("Type", "Data"))


def _add(
    opinions: LabelOpinions,
    label: ClassLabel,
    encodings: Iterable[Encoding],
    taken: set[str],
    known: Iterable[tuple[Encoding, str]] = (),
) -> None:
    """Add what says `label` in each encoding, where nothing is known in that encoding and taxonomy.

    Args:
        opinions: what is added to.
        label: the class.
        encodings: those to write.
        taken: names of Isaac's instances that hold other labels.
        known: encodings and taxonomies that have labels.
    """
    if "UsdSemantics" in encodings:
        for taxonomy, values in _taxonomies(label).items():
            if ("UsdSemantics", taxonomy) not in known:
                opinions.tokens[USD + taxonomy] = values
                opinions.applied.append(usd_schema(taxonomy))
    if "Isaac" in encodings:
        for taxonomy, text in _isaac_labels(label).items():
            if ("Isaac", taxonomy) not in known:
                instance = _free_instance(taxonomy, taken)
                opinions.texts[isaac_property(instance, "Type")] = taxonomy
                opinions.texts[isaac_property(instance, "Data")] = text
                opinions.applied.append(isaac_schema(instance))
    if "Multiverse" in encodings and not any(encoding == "Multiverse" for encoding, _ in known):
        opinions.is_tagged = True
        opinions.applied.append(TAG_SCHEMA)


def _taxonomies(label: ClassLabel) -> Mapping[str, tuple[str, ...]]:
    told = {"class": (*label.above, label.token), "iri": (label.iri,), "wikidata_qcode": label.qcodes}
    return {taxonomy: values for taxonomy, values in told.items() if values}


def _isaac_labels(label: ClassLabel) -> Mapping[str, str]:
    """Return taxonomy → text: Isaac's labels are single texts, and the classes above a class are a path before it."""
    told = {"class": label.token, "iri": label.iri}
    if label.qcodes:
        told["qcode"] = label.qcodes[0]
    return {**told, "hierarchy": "/".join((*label.above, label.token))} if label.above else told


def _free_instance(taxonomy: str, taken: set[str]) -> str:
    names = [_ISAAC_CLASS] if taxonomy == "class" else []
    names += [f"{_ISAAC_CLASS}_{taxonomy}{suffix}" for suffix in ("", *(f"_{n}" for n in range(2, len(taken) + 3)))]
    return next(name for name in names if name not in taken)
