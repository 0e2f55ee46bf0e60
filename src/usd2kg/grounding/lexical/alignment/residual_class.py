"""The default class of a TBox: the class that is true of most objects, or a residual class such as “other”."""

from collections import Counter

from usd2kg.grounding.lexical.alignment.label_words import head_noun_of, words_of_label
from usd2kg.grounding.lexical.alignment.terms import AlignedClass
from usd2kg.grounding.lexical.concepts.senses import usual_sense
from usd2kg.grounding.lexical.concepts.taxonomy import Taxonomy
from usd2kg.knowledge import word_set
from usd2kg.ontology import ClassIRI, OntologyClass, TBox

__all__ = ["GENERAL_NOUNS", "align_default", "find_default_class", "is_residual", "residue_of"]

GENERAL_NOUNS = word_set("lexical", "general_nouns")
_RESIDUAL_WORDS = word_set("lexical", "residual_words")
_ANYTHING = GENERAL_NOUNS | word_set("lexical", "residual_objects")
_NEGATIONS = word_set("lexical", "negating_prefixes")
_NOT_RESIDUAL = word_set("lexical", "never_residual_nouns")
_ARTIFACT = "artifact"
"""Lemma of the synset above all made objects."""


def residue_of(label: str, taxonomy: Taxonomy) -> str | None:
    """Return the kind that the label of a residual class covers, in the singular; None for any other label.

    >>> from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
    >>> residue_of("other furniture", load_taxonomy()), residue_of("furniture", load_taxonomy())
    ('furniture', None)

    Returns:
        Empty where the label covers objects of any kind: “Sundries”, “otherprop”.
    """
    words = words_of_label(label)
    if len(words) == 1:
        # Label lists join the words: NYU40's “otherfurniture”.
        first = max(filter(words[0].startswith, _RESIDUAL_WORDS), key=len, default="")
        rest = words[0].removeprefix(first)
        words = [first, rest] if first and taxonomy.singular(rest) in taxonomy else words
    if _RESIDUAL_WORDS.isdisjoint(words):
        return None
    *before, last = [word for word in words if word not in _RESIDUAL_WORDS] or [""]
    residue = [*before, taxonomy.singular(last)]
    return "" if _ANYTHING.issuperset(filter(None, residue)) else " ".join(residue)


def is_residual(cls: OntologyClass, taxonomy: Taxonomy) -> bool:
    """Return whether a class is labelled as a residual class for objects of any kind."""
    return residue_of(cls.label, taxonomy) == ""


def align_default(
    default: ClassIRI | None, tbox: TBox, taxonomy: Taxonomy, sense_classes: dict[int, AlignedClass]
) -> None:
    """Align the artifact synset with the default class, unless a class is aligned with it or with a hypernym.

    A wall then gets the default class in an ontology without walls, instead of the class of a rarer sense or of a
    similar size. Rooms, vehicles and the like are not in a residual class; they are aligned with its root.
    """
    made = taxonomy.senses(_ARTIFACT)[0].synset
    is_covered = not sense_classes.keys().isdisjoint(up for up, _ in taxonomy.walk_up(made))
    if default is None or not sense_classes or is_covered:
        return
    sense_classes[made] = AlignedClass(default, 1.0)
    root = next(iri for iri in tbox.roots if tbox.is_subclass(default, iri))
    if root != default:
        for noun in sorted(_NOT_RESIDUAL):
            sense_classes.setdefault(taxonomy.senses(noun)[0].synset, AlignedClass(root, 1.0))


def find_default_class(tbox: TBox, taxonomy: Taxonomy) -> ClassIRI | None:
    """Return the class of objects without a more specific one; None if there is none.

    A residual class (“sundry item”, “otherprop”) if it is a root or below the root that is true of most objects; else
    that root.
    """
    root = _most_general_root(tbox, taxonomy)
    residual = [
        cls.iri
        for cls in tbox.classes
        if is_residual(cls, taxonomy) and (not cls.parents or (root is not None and tbox.is_subclass(cls.iri, root)))
    ]
    return min(residual, key=lambda iri: (tbox.depths[iri], iri), default=root)


def _most_general_root(tbox: TBox, taxonomy: Taxonomy) -> ClassIRI | None:
    """Return the root that is true of most objects; None in a list of specific classes.

    A root labelled artifact, object or the like, else the root with the most subclasses labelled as artifacts: the
    largest root may be of activities or states. If another root's label negates it (`UnControllable`), that root is
    returned: it covers what is not known to be in the first.
    """

    def is_made(label: str) -> bool:
        senses = taxonomy.senses(taxonomy.singular(head_noun_of(label)))
        return bool(senses) and senses[0].domain == "artifact"

    below = Counter(iri for cls in tbox.classes for iri in tbox.closure(cls.iri))
    made_below = Counter(iri for cls in tbox.classes if is_made(cls.label) for iri in tbox.closure(cls.iri))

    def head(root: ClassIRI) -> str:
        cls = tbox.by_iri[root]
        words = words_of_label(cls.label) or words_of_label(cls.local_name) or [""]
        return taxonomy.singular(words[-1])

    best = min(tbox.roots, key=lambda root: (head(root) not in GENERAL_NOUNS, -made_below[root], -below[root], root))
    # The single root of kinds of vehicles is a class of vehicles; one of pumps and valves may be named Component.
    is_specific = head(best) not in GENERAL_NOUNS and _is_specific(head(best), taxonomy)
    if is_specific and (len(tbox.roots) > 1 or _are_kinds_of_root(tbox, best, head(best), taxonomy)):
        return None
    label = "".join(words_of_label(tbox.by_iri[best].label))
    negated = {prefix + label for prefix in _NEGATIONS if label}
    return next((root for root in tbox.roots if "".join(words_of_label(tbox.by_iri[root].label)) in negated), best)


def _are_kinds_of_root(tbox: TBox, root: ClassIRI, noun: str, taxonomy: Taxonomy) -> bool:
    """Return whether most classes below a root, by their labels, are kinds of its noun."""
    meant = {sense.synset for sense in taxonomy.senses(noun)}
    nouns = (taxonomy.singular(head_noun_of(cls.label)) for cls in tbox.classes if cls.iri != root)
    usual = [sense for sense in (usual_sense(each, taxonomy) for each in nouns) if sense is not None]
    kinds = [sense for sense in usual if not meant.isdisjoint(up for up, _ in taxonomy.walk_up(sense.synset))]
    return 2 * len(kinds) > len(usual)


def _is_specific(noun: str, taxonomy: Taxonomy) -> bool:
    """Return whether a noun denotes a specific kind of object, rather than `artifact` or a hypernym of it."""
    usual = usual_sense(noun, taxonomy)
    made = taxonomy.senses(_ARTIFACT)[0].synset
    return usual is not None and usual.synset not in {up for up, _ in taxonomy.walk_up(made)}
