"""The class of what has no other: the one that is true of most things, or that is called after the rest."""

from collections import Counter

from usd2kg.grounding.lexical.alignment.class_labels import head_of, words_of_label
from usd2kg.grounding.lexical.alignment.terms import Anchor
from usd2kg.grounding.lexical.concepts.senses import sense_weight
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.ontology import ClassIRI, OntologyClass, TBox

__all__ = ["GENERAL", "anchor_default", "default_class", "is_residual", "residue_of"]

GENERAL = frozenset("artifact artefact object thing product item asset equipment entity element".split())
_NEGATIONS = ("un", "non", "not")
_MADE = "artifact"
"""The lemma of all that is made."""
_RESIDUAL = frozenset("misc miscellaneous other others sundries sundry various".split())
"""Words of labels for what has no class of its own."""
_ANYTHING = GENERAL | {"and", "goods", "misc", "other", "prop", "stuff"}
_NO_SUNDRIES = ("area", "facility", "structure", "vehicle", "way")


def residue_of(label: str, taxonomy: Taxonomy) -> str | None:
    """Return what has no class of its own by a label that says so, in the singular; None for any other label.

    >>> from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
    >>> residue_of("other furniture", load_taxonomy()), residue_of("furniture", load_taxonomy())
    ('furniture', None)

    Returns:
        Empty for the rest of everything: `Sundries`, `otherprop`.
    """
    words = words_of_label(label)
    if len(words) == 1:
        # Lists of labels write it as one: NYU40's `otherfurniture`.
        first = next((word for word in _RESIDUAL if words[0].startswith(word)), "")
        rest = words[0].removeprefix(first)
        words = [first, rest] if first and taxonomy.singular(rest) in taxonomy else words
    if _RESIDUAL.isdisjoint(words):
        return None
    *before, last = [word for word in words if word not in _RESIDUAL] or [""]
    residue = [*before, taxonomy.singular(last)]
    return "" if _ANYTHING.issuperset(filter(None, residue)) else " ".join(residue)


def is_residual(cls: OntologyClass, taxonomy: Taxonomy) -> bool:
    """Return whether a class is of the things that have no other."""
    return residue_of(cls.label, taxonomy) == ""


def anchor_default(default: ClassIRI | None, tbox: TBox, taxonomy: Taxonomy, anchors: dict[int, Anchor]) -> None:
    """Let what is made be of the default class where no class is above all that is made.

    So a wall is understood in an ontology without walls, and is not taken for what a lesser meaning of the word, or its
    size, would make it. Where no class is any kind of thing there is nothing to be understood. A class of sundries has
    neither rooms nor vehicles: of these no more is known than their root.
    """
    made = taxonomy.senses(_MADE)[0].synset
    if default is None or not anchors or not anchors.keys().isdisjoint(up for up, _ in taxonomy.walk_up(made)):
        return
    anchors[made] = Anchor(default, 1.0)
    root = next(iri for iri in tbox.roots if tbox.is_subclass(default, iri))
    if root != default:
        for noun in _NO_SUNDRIES:
            anchors.setdefault(taxonomy.senses(noun)[0].synset, Anchor(root, 1.0))


def default_class(tbox: TBox, taxonomy: Taxonomy) -> ClassIRI | None:
    """Return the class of what has no other; None if there is none.

    Where a class is called after the rest (`sundry item`, `otherprop`) it is that one, if it is a root or below the one
    that is true of most things: of other activities no thing is one. Else it is that root.
    """
    root = _root_of_most(tbox, taxonomy)
    residual = [
        cls.iri
        for cls in tbox.classes
        if is_residual(cls, taxonomy) and (not cls.parents or (root is not None and tbox.is_subclass(cls.iri, root)))
    ]
    return min(residual, key=lambda iri: (tbox.depths[iri], iri), default=root)


def _root_of_most(tbox: TBox, taxonomy: Taxonomy) -> ClassIRI | None:
    """Return the root that is true of most things: an artifact or object by its name, else the one with most below.

    An ontology's largest root may be of activities or states, and no thing is one of those: only what is called after
    something made counts. Where a root is called the opposite of the best one, as `UnControllable` is, it has all that
    is not known to be of the other. Of a list of chairs, tables and doors none is true of anything else.
    """

    def is_made(label: str) -> bool:
        senses = taxonomy.senses(taxonomy.singular(head_of(label)))
        return bool(senses) and senses[0].domain == "artifact"

    below = Counter(iri for cls in tbox.classes for iri in tbox.closure(cls.iri))
    made_below = Counter(iri for cls in tbox.classes if is_made(cls.label) for iri in tbox.closure(cls.iri))

    def head(root: ClassIRI) -> str:
        words = words_of_label(tbox.by_iri[root].label) or words_of_label(tbox.by_iri[root].local_name) or [""]
        return taxonomy.singular(words[-1])

    best = min(tbox.roots, key=lambda root: (head(root) not in GENERAL, -made_below[root], -below[root], root))
    if len(tbox.roots) > 1 and head(best) not in GENERAL and _is_one_kind(head(best), taxonomy):
        return None
    called = "".join(words_of_label(tbox.by_iri[best].label))
    opposites = {negation + called for negation in _NEGATIONS if called}
    return next((root for root in tbox.roots if "".join(words_of_label(tbox.by_iri[root].label)) in opposites), best)


def _is_one_kind(noun: str, taxonomy: Taxonomy) -> bool:
    """Return whether a noun means one kind of thing among others, and not all that is made or more."""
    usual = max(taxonomy.senses(noun), key=sense_weight, default=None)
    made = taxonomy.senses(_MADE)[0].synset
    return usual is not None and usual.synset not in {up for up, _ in taxonomy.walk_up(made)}
