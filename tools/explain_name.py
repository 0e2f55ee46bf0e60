"""Print how the lexical grounder reads one name: words, head nouns, matches, evidence, the class and its confidence.

Usage: python -m tools.explain_name NAME [--parents World/Kitchen] [--size 0.26 0.26 0.11] [--ontology FILE]

`--size` has the three extents in metres, in any order. docs/grounding.md explains each step.
"""

import argparse
from pathlib import Path

from usd2kg.grounding import ObjectView
from usd2kg.grounding.lexical.concepts.extent import extent_of
from usd2kg.grounding.lexical.concepts.sizes import Size
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.reading.head_noun import head_likelihood
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox


def explain(name: str, parents: tuple[str, ...], size: Size | None, tbox: TBox) -> list[str]:
    """Return the lines to print."""
    grounder = LexicalGrounder()
    matcher = grounder.object_grounder(tbox).matcher
    phrase = grounder.object_grounder(tbox).reader.read(name, parents)
    lines = [
        f"words: {' '.join(phrase.words)}",
        *(f"  “{written}” read as “{read}”" for written, read in phrase.corrections),
    ]
    candidates = matcher.head_candidates(phrase, parents, extent_of(size))
    total = sum(head_likelihood(features) for _, features, _ in candidates)
    lines.append("head nouns:")
    for _, features, head in candidates:
        known = ", ".join(f"{key} {value:.2f}" for key, value in features._asdict().items() if value)
        lines.append(f"  {head_likelihood(features) / total:.3f}  {' '.join(head.words)}  ({known})")
        lines += [f"           {match.score:.2f}  {match.reason()}" for match in head.matches[:3]]
    lines.append("classes:")
    for match in matcher.match(phrase, parents, extent_of(size))[:3]:
        lines.append(f"  {match.score:.2f}  {tbox.by_iri[match.class_iri].readable_name}: {match.explanation}")
    view = ObjectView(name=name, parents=parents, size=size)
    (scored,) = grounder.score_views([("/", view)], tbox)
    (prediction,) = grounder.ground_views([("/", view)], tbox)
    lines.append(f"all evidence; decided by: {', '.join(scored.prediction.evidence) or 'nothing'}")
    lines += [
        f"  {found.score:.2f}  {tbox.by_iri[found.class_iri].readable_name}" for found in prediction.candidates[:3]
    ]
    if prediction.class_iri is None:
        return [*lines, f"no class: {prediction.explanation}"]
    chosen = tbox.by_iri[prediction.class_iri].readable_name
    return [*lines, f"{chosen}, confidence {prediction.confidence:.2f}: {prediction.explanation}"]


def main() -> None:
    """Read the arguments and print."""
    parser = argparse.ArgumentParser(description="Print how the lexical grounder reads one name.")
    parser.add_argument("name")
    parser.add_argument("--parents", default="", help="names of the prims above, separated by /")
    parser.add_argument("--size", nargs=3, type=float, help="extents in metres")
    parser.add_argument("--ontology", type=Path)
    arguments = parser.parse_args()
    parents = tuple(filter(None, arguments.parents.split("/")))
    size = tuple(arguments.size) if arguments.size else None
    print("\n".join(explain(arguments.name, parents, size, open_tbox(arguments.ontology))))


if __name__ == "__main__":
    main()
