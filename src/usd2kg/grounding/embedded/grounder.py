"""The default grounder: no network, no key, no GPU.

A name is read as a noun phrase; the TBox's terms, then the taxonomy of nouns, say which class it names. Where the
name says nothing, other evidence speaks: asset, documentation, parts, and at last the company the object keeps.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice

from usd2kg.grounding.embedded.lexicon import build_lexicon
from usd2kg.grounding.embedded.matching import Match, Matcher
from usd2kg.grounding.embedded.names import NameReader
from usd2kg.grounding.embedded.taxonomy import load_taxonomy
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox
from usd2kg.scene import ObjectView
from usd2kg.words import words_of

__all__ = ["EmbeddedGrounder"]

_SHARES = {"name": 1.0, "asset": 0.9, "documentation": 0.8, "hierarchy": 0.55, "parts": 0.5}
"""How far each source of words is trusted, as a share of what the name would be."""
_SOURCES = {"asset": "asset", "documentation": "documentation", "hierarchy": "group", "parts": "parts"}
_CLEAR = 0.7
"""A name that scores this is believed before other evidence is asked."""
_PRIMITIVES = frozenset(["box", "cube", "sphere", "cylinder", "capsule", "cone", "plane", "torus", "convex", "hull"])
"""Parts named after a geometric primitive say how a thing was modelled, not what it is."""
_COMPANY = 0.45
_COMPANY_SAMPLE = 200
_UNKNOWN = 0.28
_DEFAULT = 0.1
_CANDIDATES = 8


@dataclass(frozen=True, slots=True)
class _Finding:
    group: str
    match: Match


class EmbeddedGrounder:
    """Grounds by the words of names, a noun taxonomy and the company an object keeps."""

    name = "embedded"
    is_calibrated = False

    def __init__(self, *, use_home_synonyms: bool = True) -> None:
        """Make the grounder.

        Args:
            use_home_synonyms: also use the synonyms of the built-in home TBox, for classes with the same IRI.
        """
        self._use_home_synonyms = use_home_synonyms

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that its answers depend on."""
        return {"home_synonyms": str(self._use_home_synonyms).lower()}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view)."""
        run = _Run(tbox, self._home_synonyms())
        return [replace(run.predict(view), prim_path=path) for path, view in views]

    def _home_synonyms(self) -> dict[ClassIRI, tuple[str, ...]]:
        if not self._use_home_synonyms:
            return {}
        return {cls.iri: (cls.label, *cls.alt_labels) for cls in load_home_tbox().classes}


class _Run:
    """One TBox's lexicon and matcher; remembers what names mean, which depends on nothing else."""

    def __init__(self, tbox: TBox, synonyms: Mapping[ClassIRI, tuple[str, ...]]) -> None:
        taxonomy = load_taxonomy()
        self._tbox = tbox
        self._lexicon = build_lexicon(tbox, taxonomy, synonyms)
        self._reader = NameReader(self._lexicon, taxonomy)
        self._matcher = Matcher(tbox, self._lexicon, taxonomy, self._reader)
        self._match = lru_cache(maxsize=100_000)(self._match_text)

    def predict(self, view: ObjectView) -> Prediction:
        findings = self._by_words(view)
        if not findings and (view.is_masked or not words_of(view.name)):
            findings = self._by_company(view)
        if not findings or findings[0].match.score < _UNKNOWN:
            return self._default("what is known about it does not say what it is")
        best = findings[0]
        scores = {finding.match.class_iri: finding.match.score for finding in reversed(findings)}
        candidates = sorted(
            (Candidate(iri, score) for iri, score in scores.items()), key=lambda c: (-c.score, c.class_iri)
        )
        return Prediction(
            prim_path="",
            class_iri=best.match.class_iri,
            confidence=round(best.match.score, 4),
            status=Status.GROUNDED,
            grounder=EmbeddedGrounder.name,
            explanation=best.match.explanation,
            evidence=(best.group,),
            candidates=tuple(candidates[:_CANDIDATES]),
        )

    def _by_words(self, view: ObjectView) -> list[_Finding]:
        """Return what the words say, best first; other sources are asked only if the name is not clear."""
        findings: list[_Finding] = []
        for group, text in _texts(view):
            if group in {"hierarchy", "parts"} and self._says_what_it_is(view.name):
                # A tulip is no class of the TBox; that it has a stem does not make it a tube.
                break
            for match in self._match(text, view.parents if group == "name" else ()):
                said = match.explanation if group == "name" else f"{match.explanation} (from its {_SOURCES[group]})"
                findings.append(_Finding(group, Match(match.class_iri, match.score * _SHARES[group], said)))
            findings.sort(key=_by_score)
            if findings and findings[0].match.score >= _CLEAR:
                break
        return findings

    def _says_what_it_is(self, name: str) -> bool:
        words = self._reader.read(name).words
        return bool(words) and not self._reader.is_modifier(words[-1]) and self._reader.is_noun(words[-1])

    def _match_text(self, text: str, parents: tuple[str, ...]) -> tuple[Match, ...]:
        return tuple(self._matcher.match(self._reader.read(text, parents), parents))

    def _by_company(self, view: ObjectView) -> list[_Finding]:
        """Return the class that most of the objects beside it have; none if they are a mixed company."""
        votes: Counter[ClassIRI] = Counter()
        for sibling in islice(view.siblings, _COMPANY_SAMPLE):
            matches = self._match(sibling, view.parents)
            if matches and matches[0].score >= _CLEAR:
                votes[matches[0].class_iri] += 1
        total = sum(votes.values())
        iri, count = min(votes.items(), key=lambda item: (-item[1], item[0]), default=("", 0))
        if count <= total / 2:
            return []
        return [_Finding("hierarchy", Match(iri, _COMPANY * count / total, self._company_text(iri, count, total)))]

    def _company_text(self, iri: ClassIRI, count: int, total: int) -> str:
        label = self._tbox.by_iri[iri].local_name
        return f"its name says nothing; {count} of the {total} named objects beside it are {label}"

    def _default(self, reason: str) -> Prediction:
        return Prediction(
            prim_path="",
            class_iri=self._lexicon.default,
            confidence=_DEFAULT,
            status=Status.SUPERCLASS,
            grounder=EmbeddedGrounder.name,
            explanation=f"{reason}; {self._tbox.by_iri[self._lexicon.default].local_name} is true of most things",
            candidates=(Candidate(self._lexicon.default, _DEFAULT),),
        )


def _by_score(finding: _Finding) -> tuple[float, str]:
    return (-finding.match.score, finding.match.class_iri)


def _texts(view: ObjectView) -> list[tuple[str, str]]:
    """Return (evidence group, text) in the order in which they are asked."""
    texts = [("name", view.name), ("name", view.display_name)]
    texts += [("asset", asset) for asset in view.asset]
    texts.append(("documentation", _first_phrase(view.documentation)))
    texts += [("hierarchy", group) for group in reversed(view.groups) if _is_plural(group)]
    texts += [("parts", part) for part in view.parts[:20] if not _PRIMITIVES.issuperset(words_of(part))]
    return [(group, text) for group, text in dict.fromkeys(texts) if text]


def _first_phrase(documentation: str) -> str:
    """Return the beginning of a description up to the first mark or relation: `A stool for the bar.` → stool."""
    words: list[str] = []
    for word in documentation.replace("\n", " ").split():
        bare = word.strip(".,;:!?()\"'").lower()
        if words and bare in {"for", "of", "with", "in", "on", "to", "from", "that", "which", "by", "is", "at"}:
            break
        if bare not in {"a", "an", "the", "this", "is", "one", "some"}:
            words.append(bare)
        if word[-1:] in ".,;:!?":
            break
    return " ".join(words[:6])


def _is_plural(name: str) -> bool:
    """Return whether a group is named after what it holds (`mugs`, `wallUnits`) and not after a place."""
    words = words_of(name)
    return bool(words) and load_taxonomy().singular(words[-1]) != words[-1]
