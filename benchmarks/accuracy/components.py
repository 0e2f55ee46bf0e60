"""What each kind of evidence adds to the lexical grounder, on every scene with labels that is at hand.

Usage: python benchmarks/accuracy/components.py

Prints exact match in % for the whole grounder and for the grounder without one thing, per scene and naming regime; the
last column is the mean over scenes.
"""

import tomllib
from pathlib import Path
from typing import Any

from usd2kg.evaluation.gold import GoldLabel, read_gold
from usd2kg.grounding import EVIDENCE_GROUPS, NamingRegime, ground
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import Scene, read_scene

MATRIX = Path(__file__).parent / "matrix.toml"
WITHOUT = ("company", "geometry", "position", "hierarchy", "asset", "parts")
"""Evidence groups that are taken away, one at a time."""

Case = tuple[Scene, tuple[GoldLabel, ...], TBox]


def main() -> None:
    """Measure and print."""
    cases = load_cases()
    print(f"{'regime':<18}{'evidence':<22}" + "".join(f"{name[:14]:>16}" for name in cases) + f"{'mean':>8}")
    for regime in NamingRegime:
        row(regime, "all", cases, LexicalGrounder(), None)
        row(regime, "no home vocabulary", cases, LexicalGrounder(use_home_synonyms=False), None)
        row(regime, "abstaining upward", cases, LexicalGrounder(abstains=True), None)
        for group in WITHOUT:
            row(regime, f"no {group}", cases, LexicalGrounder(), EVIDENCE_GROUPS - {group})


def load_cases() -> dict[str, Case]:
    """Return the scenes that are at hand, with labels and classes."""
    cases: dict[str, Case] = {}
    scenes: list[dict[str, Any]] = tomllib.loads(MATRIX.read_text(encoding="utf-8"))["scene"]
    for scene in scenes:
        path = MATRIX.parent / scene["path"]
        if path.exists():
            tbox = open_tbox(MATRIX.parent / scene["ontology"] if "ontology" in scene else None)
            gold = read_gold(MATRIX.parent / scene["gold"], tbox)
            cases[scene["name"]] = (read_scene(path, paths=[label.prim_path for label in gold]), gold, tbox)
    return cases


def row(
    regime: NamingRegime,
    name: str,
    cases: dict[str, Case],
    grounder: LexicalGrounder,
    evidence: frozenset[str] | None,
) -> None:
    """Measure and print one row."""
    shares = [exact_match(*case, grounder, regime, evidence) for case in cases.values()]
    figures = "".join(f"{share:>16.1f}" for share in shares)
    print(f"{regime.value:<18}{name:<22}{figures}{sum(shares) / len(shares):>8.1f}", flush=True)


def exact_match(
    scene: Scene,
    gold: tuple[GoldLabel, ...],
    tbox: TBox,
    grounder: LexicalGrounder,
    regime: NamingRegime,
    evidence: frozenset[str] | None,
) -> float:
    """Return the share of objects, in %, whose class is the gold one."""
    paths = [label.prim_path for label in gold]
    answers = ground(scene, tbox, grounder, regime=regime, evidence=evidence, paths=paths).by_path
    return 100 * sum(answers[label.prim_path].class_iri == label.target for label in gold) / len(gold)


if __name__ == "__main__":
    main()
