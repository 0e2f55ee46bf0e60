"""Measure what each kind of evidence adds to the lexical grounder, on every labelled scene that is present.

Usage: python -m benchmarks.accuracy.components

Prints exact match in % of the whole grounder and of the grounder without one component, by scene and naming regime;
the last column is the mean over scenes.
"""

from collections.abc import Sequence

from benchmarks.labelled_scenes import LabelledScene, load_scene, read_accuracy_matrix
from usd2kg.grounding import EVIDENCE_GROUPS, NamingRegime, ground
from usd2kg.grounding.lexical.grounder import LexicalGrounder

REMOVED = ("neighbours", "geometry", "position", "hierarchy", "asset", "parts")
"""Evidence groups that are removed, one at a time."""


def main() -> None:
    """Measure and print."""
    cases = [load_scene(spec) for spec in read_accuracy_matrix().scenes if spec.missing is None]
    print(f"{'regime':<18}{'evidence':<22}" + "".join(f"{case.name[:14]:>16}" for case in cases) + f"{'mean':>8}")
    for regime in NamingRegime:
        print_row(regime, "all", cases, LexicalGrounder(), None)
        print_row(regime, "no home vocabulary", cases, LexicalGrounder(use_home_synonyms=False), None)
        print_row(regime, "abstaining upward", cases, LexicalGrounder(abstains=True), None)
        for group in REMOVED:
            print_row(regime, f"no {group}", cases, LexicalGrounder(), EVIDENCE_GROUPS - {group})


def print_row(
    regime: NamingRegime,
    name: str,
    cases: Sequence[LabelledScene],
    grounder: LexicalGrounder,
    evidence: frozenset[str] | None,
) -> None:
    """Measure and print one row."""
    shares = [exact_match(case, grounder, regime, evidence) for case in cases]
    figures = "".join(f"{share:>16.1f}" for share in shares)
    print(f"{regime.value:<18}{name:<22}{figures}{sum(shares) / len(shares):>8.1f}", flush=True)


def exact_match(
    case: LabelledScene, grounder: LexicalGrounder, regime: NamingRegime, evidence: frozenset[str] | None
) -> float:
    """Return the share of objects, in %, whose class is the gold one."""
    answers = ground(case.scene, case.tbox, grounder, regime=regime, evidence=evidence, paths=case.paths).by_path
    return 100 * sum(answers[label.prim_path].class_iri == label.target for label in case.gold) / len(case.gold)


if __name__ == "__main__":
    main()
