"""lint_stage: problems of the labels of a stage, by themselves, against an ontology and against grounded classes."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from usd2kg.labels.class_index import ClassIndex, normalize_name
from usd2kg.labels.prim_classes import PrimClasses
from usd2kg.labels.settings import LINT
from usd2kg.labels.survey import LabelledPrim, LabelSurvey, survey_labels
from usd2kg.ontology import ClassIRI, TBox, compact_iri, local_name, read_closure
from usd2kg.scene import Label, ReadOptions, class_words
from usd2kg.scene.label_lint import LabelProblem
from usd2kg.tracing import traced
from usd2kg.validation import Finding, Severity
from usd2kg.validation.finding import sort_findings

__all__ = ["LabelLint", "lint_stage"]

_ERRORS = frozenset(
    """
    encodings-contradict isaac-half isaac-instance label-placeholder label-type label-without-schema property-misspelt
    tag-target-missing tag-target-no-class unreadable
    """.split()
)
"""Single-prim rules that are errors, since tools would read a wrong label or none; other rules are warnings."""
_EXPECTED = {
    "encodings-contradict": "one class in all encodings",
    "isaac-half": "both semanticType and semanticData under one instance name",
    "label-empty": "a label",
    "label-placeholder": "the name of a class",
    "label-repeated": "each label once",
    "label-without-schema": "the schema applied beside its labels",
    "schema-without-label": "a label beside the schema",
    "tag-target-missing": "a class prim on the stage",
    "tag-target-no-class": "a class prim with rdf:conceptName",
    "unreadable": "labels that OpenUSD can read",
}
"""Rule for single prims → what was expected, if the problem itself does not state it."""


@dataclass(frozen=True)
class LabelLint:
    """The findings about the labels of one stage."""

    findings: tuple[Finding, ...]
    """Most serious first, grouped by rule."""
    prims: int
    """Number of labelled prims."""

    def counts(self) -> dict[str, int]:
        """Return severity → number of findings."""
        counted = Counter(finding.severity.value for finding in self.findings)
        return {severity.value: counted[severity.value] for severity in Severity}


@traced("lint", lambda lint: {"findings": len(lint.findings)})
def lint_stage(
    scene: Path | str, tbox: TBox, grounded: PrimClasses | None = None, options: ReadOptions | None = None
) -> LabelLint:
    """Return the problems of the labels of a stage.

    Args:
        scene: the stage's root layer.
        tbox: the ontology whose classes the labels should name.
        grounded: the current class of each prim; labels of unrelated classes are stale.
        options: how to read the stage and select objects.

    Raises:
        SceneError: the scene cannot be read.
        OntologyError: a document of the ontology can no longer be read.
    """
    survey = survey_labels(scene, options)
    classes = ClassIndex(tbox, read_closure(tbox))
    findings = [
        *map(_prim_finding, survey.problems),
        *_lint_names(survey, classes),
        *_lint_iris(survey, classes),
        *_lint_spellings(survey),
        *_lint_invisible(survey),
        *_lint_inherited(survey),
        *(finding for prim in survey.labelled for finding in _lint_class_and_iri(prim, classes)),
        *_lint_same_geometry(survey, classes),
        *(_lint_stale(survey, classes, grounded) if grounded is not None else ()),
    ]
    return LabelLint(sort_findings(findings), len(survey.labelled))


def _finding(
    severity: Severity, rule: str, path: str, found: str, expected: str, advice: str, iri: ClassIRI = ""
) -> Finding:
    return Finding(severity, rule, path.rpartition("/")[2], path, iri, found, expected, advice)


def _prim_finding(problem: LabelProblem) -> Finding:
    severity = Severity.ERROR if problem.rule in _ERRORS else Severity.WARNING
    where = f" (in {Path(problem.layer).name})" if problem.layer else ""
    expected = problem.expected or _EXPECTED.get(problem.rule, "")
    advice = problem.advice[:1].upper() + problem.advice[1:] + "."
    return _finding(severity, problem.rule, problem.prim_path, problem.found + where, expected, advice)


def _class_labels(labels: Iterable[Label]) -> list[Label]:
    """Return the labels that name a class in words."""
    return [label for label in labels if label.taxonomy == "class" and label.strength == "label"]


def _class_names(labels: Iterable[Label]) -> list[str]:
    return [label.value for label in _class_labels(labels)]


def _class_iris(labels: Iterable[Label]) -> list[ClassIRI]:
    return [label.iri for label in labels if label.iri is not None and label.strength == "label"]


def _group_prims(values: Iterable[tuple[LabelledPrim, list[str]]]) -> Mapping[str, list[str]]:
    """Return value → paths of the prims that have it, from the values of each prim."""
    found: dict[str, list[str]] = defaultdict(list)
    for prim, of_prim in values:
        for value in dict.fromkeys(of_prim):
            found[value].append(prim.prim_path)
    return found


def _prim_count(paths: list[str]) -> str:
    """Return a message suffix with the number of prims that share a problem; empty for one prim."""
    return "" if len(paths) == 1 else f", on {len(paths)} prims"


def _quote(labels: Iterable[Label]) -> str:
    values = dict.fromkeys(label.value for label in labels)
    return ", ".join(map(repr, list(values)[: LINT.max_quoted_labels]))


def _lint_names(survey: LabelSurvey, classes: ClassIndex) -> Iterator[Finding]:
    """Yield a finding for each distinct label that names no class of the ontology, or a deprecated one."""
    for value, paths in _group_prims((prim, _class_names(prim.labels)) for prim in survey.labelled).items():
        named = classes.find(value)
        for iri in sorted(named & classes.deprecated.keys()):
            found = f"the label {value!r} names a deprecated class{_prim_count(paths)}"
            yield _deprecated_finding(iri, found, paths[0], classes)
        if not named:
            similar = classes.suggest(value)
            found = f"the label {value!r} names no class{_prim_count(paths)}"
            expected = f"the name of a class{f', such as {similar}' if similar else ''}"
            advice = f"Write {similar} if it is intended." if similar else "Use a class name, or give its ontology."
            yield _finding(Severity.WARNING, "class-unknown", paths[0], found, expected, advice)


def _lint_iris(survey: LabelSurvey, classes: ClassIndex) -> Iterator[Finding]:
    """Yield a finding for each distinct IRI that is not a class of the ontology, or is a deprecated one."""
    for iri, paths in _group_prims((prim, _class_iris(prim.labels)) for prim in survey.labelled).items():
        if iri in classes.deprecated:
            found = f"the class <{iri}> is deprecated{_prim_count(paths)}"
            yield _deprecated_finding(iri, found, paths[0], classes)
        elif iri not in classes.iris:
            yield _unknown_iri_finding(iri, paths, classes)


def _deprecated_finding(iri: ClassIRI, found: str, path: str, classes: ClassIndex) -> Finding:
    replacement = classes.deprecated[iri]
    expected = f"<{replacement}>, which replaces it" if replacement else "a class that is not deprecated"
    return _finding(Severity.WARNING, "class-deprecated", path, found, expected, "Label the prim again.", iri)


def _unknown_iri_finding(iri: ClassIRI, paths: list[str], classes: ClassIndex) -> Finding:
    if not classes.is_own_namespace(iri):
        found = f"<{iri}> belongs to another ontology{_prim_count(paths)}"
        advice = "Check it with its ontology, --ontology, or label the prim again."
        return _finding(Severity.NOTE, "iri-foreign", paths[0], found, "a class of the ontology", advice, iri)
    similar = classes.suggest(local_name(iri))
    found = f"<{iri}> is not a class of the ontology{_prim_count(paths)}"
    expected = f"a class of the ontology{f', such as {similar}' if similar else ''}"
    return _finding(Severity.ERROR, "iri-unknown", paths[0], found, expected, "Correct the IRI.", iri)


def _lint_spellings(survey: LabelSurvey) -> Iterator[Finding]:
    """Yield a finding for each label that differs from a more frequent one only in case or separators."""
    spellings: dict[tuple[str, str], dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for prim in survey.labelled:
        for label in prim.labels:
            if label.encoding != "Multiverse" and label.taxonomy != "iri":
                spellings[label.taxonomy, normalize_name(label.value)][label.value].append(prim.prim_path)
    for (taxonomy, _), paths in spellings.items():
        usual, *others = sorted(paths, key=lambda value: (-len(paths[value]), value))
        for value in others:
            count = len(paths[value])
            found = (
                f"{taxonomy} is {value!r} on {count} {'prim' if count == 1 else 'prims'}, but {usual!r} on "
                f"{len(paths[usual])}, such as {paths[usual][0]}"
            )
            advice = "Use one spelling; tools compare labels exactly."
            yield _finding(Severity.WARNING, "spelling-varies", paths[value][0], found, repr(usual), advice)


def _lint_invisible(survey: LabelSurvey) -> Iterator[Finding]:
    """Yield a finding for each labelled prim without geometry."""
    for prim in survey.labelled:
        if not prim.has_geometry:
            found = f"labelled {_quote(prim.labels)}, but neither the prim nor its descendants have geometry"
            advice = "Label the object itself, or remove the label."
            yield _finding(Severity.NOTE, "label-unseen", prim.prim_path, found, "labels on geometry", advice)


def _lint_inherited(survey: LabelSurvey) -> Iterator[Finding]:
    """Yield a finding for each prim whose class label is inherited by objects without one."""
    labelled = {prim.prim_path: prim for prim in survey.labelled}
    for path, objects in survey.inheriting.items():
        prim = labelled.get(path)
        count = f"{len(objects)} {'object' if len(objects) == 1 else 'objects'}"
        some = ", ".join(objects[: LINT.max_quoted_labels]) + ("…" if len(objects) > LINT.max_quoted_labels else "")
        found = f"inherited by {count} without a class label: {some}"
        if prim is not None:
            found = f"{_quote(prim.labels)} is {found}"
        is_object = prim is not None and prim.is_object
        severity = Severity.NOTE if is_object else Severity.WARNING
        advice = "Label them as well" + ("." if is_object else ", or remove the label of the group.")
        yield _finding(severity, "label-inherited", path, found, "a class label on each object", advice)


def _lint_class_and_iri(prim: LabelledPrim, classes: ClassIndex) -> Iterator[Finding]:
    """Yield a finding for each class label of a prim that contradicts its IRI label."""
    for iri in (iri for iri in _class_iris(prim.labels) if iri in classes.iris):
        # The synonyms of superclasses are too general to compare with; their local names are not.
        words = classes.words(iri).union(*(class_words(up) for up in classes.superclasses(iri)))
        for label in _class_labels(prim.labels):
            named = classes.find(label.value)
            is_same = any(classes.are_related(cls, iri) for cls in named)
            if not is_same and (named or class_words(label.value).isdisjoint(words)):
                found = f"class is {label.value!r} ({label.encoding}), but iri is {compact_iri(iri)}"
                expected = "one class in all taxonomies"
                advice = "Correct one of them."
                yield _finding(Severity.ERROR, "class-iri-contradict", prim.prim_path, found, expected, advice, iri)


def _classes_and_words(labels: Iterable[Label], classes: ClassIndex) -> tuple[frozenset[ClassIRI], frozenset[str]]:
    """Return the classes that labels refer to, by IRI or else by name, and the words of both."""
    labels = list(labels)
    iris, names = _class_iris(labels), _class_names(labels)
    known = frozenset(iri for iri in iris if iri in classes.iris)
    named = frozenset(iri for name in names for iri in classes.find(name))
    return known or named, frozenset(word for value in (*names, *iris) for word in class_words(value))


def _lint_same_geometry(survey: LabelSurvey, classes: ClassIndex) -> Iterator[Finding]:
    """Yield a finding for each prim with the same geometry as a labelled ancestor but an unrelated class."""
    labels = {prim.prim_path: prim.labels for prim in survey.labelled}
    for prim in survey.labelled:
        if prim.same_as is None:
            continue
        (own, words), (others, other_words) = (
            _classes_and_words(each, classes) for each in (prim.labels, labels[prim.same_as])
        )
        if words and other_words and words.isdisjoint(other_words) and not _are_compatible(own, others, classes):
            value, other = (", ".join(sorted(set(_class_names(each)))) for each in (prim.labels, labels[prim.same_as]))
            found = f"labelled {value}, but {prim.same_as}, which has the same geometry, is labelled {other}"
            advice = "Keep the label of the object and remove the other."
            expected = "one class per object"
            yield _finding(Severity.WARNING, "above-contradicts", prim.prim_path, found, expected, advice)


def _are_compatible(one: Iterable[ClassIRI], other: Iterable[ClassIRI], classes: ClassIndex) -> bool:
    """Return whether any class of one is related to any class of the other."""
    other = list(other)
    return any(classes.are_related(cls, another) for cls in one for another in other)


def _lint_stale(survey: LabelSurvey, classes: ClassIndex, grounded: PrimClasses) -> Iterator[Finding]:
    """Yield a finding for each prim whose labels name a class unrelated to the grounded one."""
    for prim in survey.labelled:
        entry = grounded.by_path.get(prim.prim_path)
        if entry is None or entry.class_iri is None:
            continue
        labelled, words = _classes_and_words(prim.labels, classes)
        if not words or _are_compatible(labelled, [entry.class_iri], classes):
            continue
        if labelled or words.isdisjoint(classes.words(entry.class_iri)):
            confidence = "" if entry.confidence is None else f" ({entry.confidence:.2f})"
            expected = f"the class of the run, {compact_iri(entry.class_iri)}{confidence}"
            advice = "Label it again with --mode overwrite, or correct the run with a decision."
            found = f"labelled {_quote(prim.labels)}"
            yield _finding(Severity.WARNING, "label-stale", prim.prim_path, found, expected, advice, entry.class_iri)
