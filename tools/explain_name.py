"""Print how the lexical grounder reads one name: words, head nouns, matches and the class.

Usage: python -m tools.explain_name NAME [--parents World/Kitchen] [--size 0.26 0.26 0.11] [--ontology FILE]

`--size` has the three extents in metres, in any order. docs/grounding.md explains each step.
"""

import argparse
from pathlib import Path

from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.sizes import Size
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.matching.phrase_matching import PhraseMatcher
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.reading.head_noun import head_likelihood
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox


def explain(name: str, parents: tuple[str, ...], size: Size | None, tbox: TBox) -> list[str]:
    """Return the lines to print."""
    taxonomy = load_taxonomy()
    lexicon = build_lexicon(tbox, taxonomy, home_names())
    reader = NameReader(lexicon, taxonomy)
    matcher = PhraseMatcher(TermMatcher(tbox, lexicon, taxonomy, reader), taxonomy, reader)
    phrase = reader.read(name, parents)
    lines = [
        f"words: {' '.join(phrase.words)}",
        *(f"  “{written}” read as “{read}”" for written, read in phrase.corrections),
    ]
    candidates = matcher.head_candidates(phrase, parents, size)
    total = sum(head_likelihood(features) for _, features, _ in candidates)
    lines.append("head nouns:")
    for _, features, head in candidates:
        known = ", ".join(f"{key} {value:.2f}" for key, value in features._asdict().items() if value)
        lines.append(f"  {head_likelihood(features) / total:.3f}  {' '.join(head.words)}  ({known})")
        lines += [f"           {match.score:.2f}  {match.reason()}" for match in head.matches[:3]]
    lines.append("classes:")
    for match in matcher.match(phrase, parents, size)[:3]:
        lines.append(f"  {match.score:.2f}  {tbox.by_iri[match.class_iri].readable_name}: {match.explanation}")
    return lines


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
