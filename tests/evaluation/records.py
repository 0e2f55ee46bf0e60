"""A small TBox and scores over it, for results computed by hand.

The hierarchy; Cup has two superclasses::

    Thing ─ Container ─ Cup
          │           └ Bowl
          └ Tableware ┬ Cup
                      └ Spoon
    Wall (a second root)
"""

from usd2kg.evaluation.gold import GoldLabel
from usd2kg.evaluation.score import Score
from usd2kg.grounding import Candidate, Grounding, Prediction, Status
from usd2kg.ontology import OntologyClass, TBox

E = "http://example.org/t#"
PARENTS = {
    "Thing": (),
    "Container": ("Thing",),
    "Tableware": ("Thing",),
    "Cup": ("Container", "Tableware"),
    "Bowl": ("Container",),
    "Spoon": ("Tableware",),
    "Wall": (),
}


def small_tbox() -> TBox:
    classes = tuple(
        OntologyClass(E + name, name, (), "", tuple(sorted(E + parent for parent in parents)))
        for name, parents in sorted(PARENTS.items())
    )
    return TBox("small", E, None, "sha256:0", classes)


def score(target: str, answer: str | None, confidence: float | None = 0.9, name: str = "a", also: str = "") -> Score:
    return Score(
        id=f"/w/{name}",
        name=name,
        target=E + target,
        also=frozenset(E + part for part in also.split("|") if part),
        answer=E + answer if answer else None,
        confidence=confidence if answer else None,
        status=Status.GROUNDED if answer else Status.REFUSED,
        explanation="because",
    )


def label(path: str, target: str, also: str = "") -> GoldLabel:
    return GoldLabel(path, E + target, frozenset(E + part for part in also.split("|") if part))


def grounding_of(answers: dict[str, str | None]) -> Grounding:
    predictions = tuple(
        Prediction(
            path,
            E + answer if answer else None,
            0.8 if answer else None,
            Status.GROUNDED if answer else Status.REFUSED,
            "fake",
            "because",
            ("name",),
            (Candidate(E + answer, 0.8),) if answer else (),
        )
        for path, answer in answers.items()
    )
    return Grounding("s.usda", "sha256:1", E, "sha256:0", "fake", {"regime": "semantic"}, False, "0", predictions)
