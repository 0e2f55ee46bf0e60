"""lint_stage: what is wrong with the labels of a stage, by themselves, against an ontology and against a run."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from usd2kg.labels.class_index import ClassIndex, name_key
from usd2kg.labels.prim_classes import PrimClasses
from usd2kg.labels.survey import LabelledPrim, LabelSurvey, survey_labels
from usd2kg.ontology import TBox, compact_iri, local_name, read_closure
from usd2kg.scene import Label, ReadOptions, class_words
from usd2kg.scene.label_lint import LabelProblem
from usd2kg.validation import Finding, Severity
from usd2kg.validation.finding import sort_findings

__all__ = ["LabelLint", "lint_stage"]

_ERRORS = frozenset(
    """
    class-iri-contradict encodings-contradict isaac-half isaac-instance label-placeholder label-type
    label-without-schema property-misspelt tag-target-missing tag-target-no-class unreadable
    """.split()
)
"""Rules of what makes tools read another label than was meant, or none."""
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
_NAME_TAXONOMY = "class"
_SHOWN = 3


@dataclass(frozen=True)
class LabelLint:
    """What is wrong with the labels of one stage."""

    findings: tuple[Finding, ...]
    """Most serious first, those of one rule together."""
    prims: int
    """Prims of the stage that carry labels."""

    def counts(self) -> dict[str, int]:
        """Return severity → number of findings."""
        counted = Counter(finding.severity.value for finding in self.findings)
        return {severity.value: counted[severity.value] for severity in Severity}


def lint_stage(
    scene: Path | str, tbox: TBox, run: PrimClasses | None = None, options: ReadOptions | None = None
) -> LabelLint:
    """Return what is wrong with the labels of a stage.

    Args:
        scene: the stage's root layer.
        tbox: the ontology whose classes labels are expected to name.
        run: the classes that objects have by now; labels that say another one are stale.
        options: how the stage is read, and which prims are objects.

    Raises:
        SceneError: the scene cannot be read.
        OntologyError: a document of the ontology cannot be read any more.
    """
    survey = survey_labels(scene, options)
    names = ClassIndex(tbox, read_closure(tbox))
    findings = [
        *map(_of_problem, survey.problems),
        *_lint_names(survey, names),
        *_lint_spellings(survey),
        *_lint_places(survey),
        *(finding for prim in survey.labelled for finding in _lint_iri(prim, names)),
        *_lint_same_geometry(survey, names),
        *(_lint_run(survey, names, run) if run is not None else ()),
    ]
    return LabelLint(sort_findings(findings), len(survey.labelled))


def _of_problem(problem: LabelProblem) -> Finding:
    severity = Severity.ERROR if problem.rule in _ERRORS else Severity.WARNING
    where = f" (in {Path(problem.layer).name})" if problem.layer else ""
    expected = problem.expected or _EXPECTED.get(problem.rule, "")
    advice = problem.advice[:1].upper() + problem.advice[1:] + "."
    return _finding(severity, problem.rule, problem.prim_path, problem.found + where, expected, advice)


def _finding(
    severity: Severity, rule: str, path: str, found: str, expected: str, advice: str, iri: str = ""
) -> Finding:
    return Finding(severity, rule, path.rpartition("/")[2], path, iri, found, expected, advice)


def _class_names(labels: Iterable[Label]) -> list[Label]:
    """Return the labels that are to name a class in words."""
    return [label for label in labels if label.taxonomy == _NAME_TAXONOMY and label.strength == "label"]


def _iris(labels: Iterable[Label]) -> list[str]:
    return [label.iri for label in labels if label.iri is not None and label.strength == "label"]


def _paths(survey: LabelSurvey, *, by_iri: bool) -> Mapping[str, list[str]]:
    """Return class name, or IRI → the prims that carry it."""
    found: dict[str, list[str]] = defaultdict(list)
    for prim in survey.labelled:
        told = _iris(prim.labels) if by_iri else [label.value for label in _class_names(prim.labels)]
        for value in dict.fromkeys(told):
            found[value].append(prim.prim_path)
    return found


def _on(paths: list[str]) -> str:
    """Return what follows a label that stands on these prims, the first of which is told already."""
    return "" if len(paths) == 1 else f", on {len(paths)} prims"


def _lint_names(survey: LabelSurvey, names: ClassIndex) -> Iterator[Finding]:
    """Yield labels that name no class of the ontology, or a deprecated one: each label once."""
    for value, paths in _paths(survey, by_iri=False).items():
        classes = names.named(value)
        for iri in sorted(classes & names.deprecated.keys()):
            yield _deprecated(iri, f"the label {value!r} names a deprecated class{_on(paths)}", paths[0], names)
        if not classes:
            like = names.suggest(value)
            advice = f"Write {like}, if that is meant." if like else "Label it with a class, or name its ontology."
            found = f"the label {value!r} names no class{_on(paths)}"
            expected = f"the name of a class{f', such as {like}' if like else ''}"
            yield _finding(Severity.WARNING, "class-unknown", paths[0], found, expected, advice)
    for iri, paths in _paths(survey, by_iri=True).items():
        if iri in names.deprecated:
            yield _deprecated(iri, f"the class <{iri}> is deprecated{_on(paths)}", paths[0], names)
        elif iri not in names.iris:
            yield _unknown_iri(iri, paths, names)


def _deprecated(iri: str, found: str, path: str, names: ClassIndex) -> Finding:
    instead = names.deprecated[iri]
    expected = f"<{instead}>, which replaces it" if instead else "a class that is not deprecated"
    return _finding(Severity.WARNING, "class-deprecated", path, found, expected, "Label it anew.", iri)


def _unknown_iri(iri: str, paths: list[str], names: ClassIndex) -> Finding:
    if names.is_own_namespace(iri):
        like = names.suggest(local_name(iri))
        found = f"<{iri}> is no class of the ontology{_on(paths)}"
        expected = f"a class of the namespace{f', such as {like}' if like else ''}"
        return _finding(Severity.ERROR, "iri-unknown", paths[0], found, expected, "Correct the IRI.", iri)
    found = f"<{iri}> is of another ontology{_on(paths)}"
    advice = "Name its ontology with --ontology to check it, or label it anew."
    return _finding(Severity.NOTE, "iri-foreign", paths[0], found, "a class of the ontology", advice, iri)


def _lint_spellings(survey: LabelSurvey) -> Iterator[Finding]:
    """Yield labels of one taxonomy that differ in case or separators alone, which tools take for different classes."""
    spelt: dict[tuple[str, str], dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for prim in survey.labelled:
        for label in prim.labels:
            if label.encoding != "Multiverse" and label.taxonomy != "iri":
                spelt[label.taxonomy, name_key(label.value)][label.value].append(prim.prim_path)
    for (taxonomy, _), spellings in spelt.items():
        usual, *others = sorted(spellings, key=lambda value: (-len(spellings[value]), value))
        for value in others:
            count = len(spellings[value])
            found = f"{taxonomy} is {value!r} on {count} {'prim' if count == 1 else 'prims'}, and {usual!r} on "
            found += f"{len(spellings[usual])}, {spellings[usual][0]} the first"
            advice = "Write it alike everywhere: tools compare labels letter by letter."
            path = spellings[value][0]
            yield _finding(Severity.WARNING, "spelling-varies", path, found, f"{usual!r}", advice)


def _lint_places(survey: LabelSurvey) -> Iterator[Finding]:
    """Yield labels on prims that nobody sees, and those that objects below inherit for want of their own."""
    labelled = {prim.prim_path: prim for prim in survey.labelled}
    for prim in survey.labelled:
        if not prim.has_geometry:
            told = ", ".join(repr(label.value) for label in prim.labels[:_SHOWN])
            found = f"it is labelled {told}, and there is no geometry at or below it"
            advice = "Label the object itself, or remove the label."
            yield _finding(Severity.NOTE, "label-unseen", prim.prim_path, found, "a label on what can be seen", advice)
    for path, below in survey.unlabelled.items():
        is_object = labelled[path].is_object if path in labelled else False
        told = ", ".join(repr(label.value) for label in labelled[path].labels[:_SHOWN]) if path in labelled else "?"
        objects = f"{len(below)} {'object' if len(below) == 1 else 'objects'}"
        some = f"{', '.join(below[:_SHOWN])}{'…' if len(below) > _SHOWN else ''}"
        found = f"{objects} below it without a class of their own inherit {told}: {some}"
        severity = Severity.NOTE if is_object else Severity.WARNING
        advice = "Label them, too" + ("." if is_object else ", or take the label from the group.")
        yield _finding(severity, "label-inherited", path, found, "a class on each object", advice)


def _lint_iri(prim: LabelledPrim, names: ClassIndex) -> Iterator[Finding]:
    """Yield a prim whose class names mean another class than its IRI says."""
    iris = [iri for iri in _iris(prim.labels) if iri in names.iris]
    for iri in iris:
        # Synonyms of the classes above are too broad to compare with.
        words = names.words(iri).union(*(class_words(up) for up in names.above(iri)))
        for label in _class_names(prim.labels):
            meant = names.named(label.value)
            is_same = any(names.are_related(cls, iri) for cls in meant)
            if not is_same and (meant or class_words(label.value).isdisjoint(words)):
                found = f"class says {label.value!r} ({label.encoding}), but the IRI says {compact_iri(iri)}"
                expected = "one class in all taxonomies"
                advice = "Correct one of them."
                yield _finding(Severity.ERROR, "class-iri-contradict", prim.prim_path, found, expected, advice, iri)


def _meant(labels: Iterable[Label], names: ClassIndex) -> tuple[frozenset[str], frozenset[str]]:
    """Return the classes that labels mean, by their IRIs or else by name, and the words that they use."""
    labels = list(labels)
    iris = frozenset(iri for iri in _iris(labels) if iri in names.iris)
    named = frozenset(iri for label in _class_names(labels) for iri in names.named(label.value))
    told = [*(label.value for label in _class_names(labels)), *_iris(labels)]
    return iris or named, frozenset(word for value in told for word in class_words(value))


def _lint_same_geometry(survey: LabelSurvey, names: ClassIndex) -> Iterator[Finding]:
    """Yield prims that are the whole geometry of a labelled prim above and say another class."""
    labels = {prim.prim_path: prim.labels for prim in survey.labelled}
    for prim in survey.labelled:
        if prim.same_as is None:
            continue
        (classes, words), (above, words_above) = (_meant(told, names) for told in (prim.labels, labels[prim.same_as]))
        if words and words_above and words.isdisjoint(words_above) and not _agree(classes, above, names):
            told, other = (
                sorted({label.value for label in _class_names(said)}) for said in (prim.labels, labels[prim.same_as])
            )
            found = (
                f"it says {', '.join(told)}, but {prim.same_as} above it, of the same geometry, says {', '.join(other)}"
            )
            advice = "Keep the label of the object and remove the other."
            yield _finding(
                Severity.WARNING, "above-contradicts", prim.prim_path, found, "one class for one thing", advice
            )


def _agree(classes: Iterable[str], others: Iterable[str], names: ClassIndex) -> bool:
    others = list(others)
    return any(names.are_related(cls, other) for cls in classes for other in others)


def _lint_run(survey: LabelSurvey, names: ClassIndex, run: PrimClasses) -> Iterator[Finding]:
    """Yield labels that say another class than the run has for their prim."""
    for prim in survey.labelled:
        answer = run.by_path.get(prim.prim_path)
        if answer is None or answer.class_iri is None:
            continue
        classes, words = _meant(prim.labels, names)
        if not words or _agree(classes, [answer.class_iri], names):
            continue
        if classes or words.isdisjoint(names.words(answer.class_iri)):
            told = ", ".join(repr(value) for value in dict.fromkeys(label.value for label in prim.labels))
            sure = "" if answer.confidence is None else f" ({answer.confidence:.2f})"
            found = f"its labels say {told}"
            expected = f"{compact_iri(answer.class_iri)}{sure}, which the run says"
            advice = "Label it anew with --mode overwrite, or correct the run by a decision."
            yield _finding(Severity.WARNING, "label-stale", prim.prim_path, found, expected, advice, answer.class_iri)
