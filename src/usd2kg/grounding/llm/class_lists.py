"""The class list of a prompt: unique class names, as a flat list or a tree."""

import random
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.prompt_options import PromptOptions
from usd2kg.grounding.llm.prompt_text import fill_template, quote
from usd2kg.ontology import ClassIRI, OntologyClass, TBox, compact_iri

__all__ = ["OfferedClasses", "list_classes", "name_classes"]


@dataclass(frozen=True, slots=True)
class OfferedClasses:
    """The classes that a prompt offers."""

    text: str
    """Their block of the prompt."""
    classes: Mapping[str, ClassIRI]
    """Name in the prompt → IRI."""


def name_classes(tbox: TBox) -> dict[ClassIRI, str]:
    """Return IRI → unique name of the class in prompts.

    The name is the local name if it is unique, else a CURIE whose prefix is the known one or the last word of the
    namespace, numbered if necessary. Characters that could be read as markup become `_`.
    """
    words = {cls.iri: re.sub(r"[^\w.\-]", "_", cls.local_name)[: LIMITS.max_quoted_characters] for cls in tbox.classes}
    counts = Counter(words.values())
    names: dict[ClassIRI, str] = {}
    taken: set[str] = set()
    for iri, word in words.items():
        base = name = word if counts[word] == 1 else f"{_prefix(iri)}:{word}"
        number = 2
        while name in taken:
            name, number = f"{base}_{number}", number + 1
        taken.add(name)
        names[iri] = name
    return names


def _prefix(iri: ClassIRI) -> str:
    curie = compact_iri(iri)
    if curie != iri:
        return curie.partition(":")[0]
    namespace = re.split(r"[#/:]", iri.rstrip("#/"))[-2:][0]
    return re.sub(r"\W", "_", re.sub(r"\.(owl|ttl|rdf)$", "", namespace)) or "ns"


def list_classes(
    tbox: TBox, names: Mapping[ClassIRI, str], offered: Mapping[ClassIRI, Any], options: PromptOptions
) -> OfferedClasses:
    """Return the offered classes as text, alphabetically or in the order and form of `options`."""
    order = list(offered) if options.has_candidates_first else sorted(offered, key=lambda iri: names[iri])
    if options.shuffle_seed is not None:
        random.Random(options.shuffle_seed).shuffle(order)
    parents = {iri: _parents(tbox, iri, offered) for iri in order}
    lines = _tree_lines if options.is_tree else _flat_lines
    text = fill_template("classes", classes="\n".join(lines(tbox, names, parents)))
    return OfferedClasses(text, {names[iri]: iri for iri in order})


def _parents(tbox: TBox, iri: ClassIRI, offered: Mapping[ClassIRI, Any]) -> list[ClassIRI]:
    """Return the most specific offered superclasses of a class."""
    direct = tbox.by_iri[iri].parents
    if all(parent in offered for parent in direct):
        return list(direct)
    above = [other for other in tbox.closure(iri) if other in offered and other != iri]
    return [one for one in above if not any(tbox.is_subclass(other, one) for other in above if other != one)]


def _flat_lines(tbox: TBox, names: Mapping[ClassIRI, str], parents: Mapping[ClassIRI, list[ClassIRI]]) -> Iterator[str]:
    for iri, above in parents.items():
        parent_names = ", ".join(sorted(names[parent] for parent in above))
        relation = f" (subClassOf: {parent_names})" if above else ""
        yield _name_and_label(names[iri], tbox.by_iri[iri]) + relation + _comment(tbox.by_iri[iri])


def _tree_lines(tbox: TBox, names: Mapping[ClassIRI, str], parents: Mapping[ClassIRI, list[ClassIRI]]) -> Iterator[str]:
    """Yield the classes indented below their superclasses; the subclasses of a repeated class are listed once."""
    children: dict[ClassIRI, list[ClassIRI]] = {iri: [] for iri in parents}
    for iri, above in parents.items():
        for parent in above:
            children[parent].append(iri)
    written: set[ClassIRI] = set()
    pending = [(iri, 0) for iri in reversed(list(parents)) if not parents[iri]]
    while pending:
        iri, depth = pending.pop()
        if iri in written:
            yield "  " * depth + names[iri] + " (see above)"
            continue
        written.add(iri)
        yield "  " * depth + _name_and_label(names[iri], tbox.by_iri[iri]) + _comment(tbox.by_iri[iri])
        pending.extend((child, depth + 1) for child in reversed(children[iri]))


def _name_and_label(name: str, cls: OntologyClass) -> str:
    """Return the name, followed by the label if that differs: `OBO_0001 "coffee cup"`."""
    same = re.sub(r"[\W_]", "", cls.label).casefold() == re.sub(r"[\W_]", "", cls.local_name).casefold()
    return name if same or not cls.label else f"{name} {quote(cls.label)}"


def _comment(cls: OntologyClass) -> str:
    return f" -- {quote(cls.comment)}" if cls.comment else ""
