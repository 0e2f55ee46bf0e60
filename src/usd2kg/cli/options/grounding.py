"""The options for grounding."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.cli.options.model import MODEL_NAMES, ModelOptions
from usd2kg.cli.options.review import ReviewOptions

if TYPE_CHECKING:
    from usd2kg.grounding import NamingRegime

__all__ = ["AbbreviatedLength", "AlignmentFile", "GroundingOptions"]

AbbreviatedLength = Annotated[
    int, Option("--abbreviated-length", min=1, help="Letters kept of each word in the abbreviated regime.")
]

AlignmentFile = Annotated[
    Path | None,
    Option(
        "--alignment",
        help="Edited file of usd2kg ontology align, for the lexical grounder; default: built from the ontology.",
    ),
]


@dataclass(frozen=True)
class GroundingOptions(OptionBundle):
    """The grounder, the evidence it uses, and decisions of a person."""

    grounder: Annotated[
        str,
        Option(
            "--grounder",
            help="Grounder: lexical, dictionary, embedding, volume, or a language model. llm-A:MODEL sends names, "
            "llm-B:MODEL context too, llm-C:MODEL asks for written reasoning first, llm-auto:MODEL chooses by each "
            f"name, llm-concept:MODEL asks once for objects that share a concept. MODEL is {MODEL_NAMES}.",
        ),
    ] = "lexical"
    dictionary: Annotated[
        Path | None,
        Option(
            "--dictionary", help="CSV file name,class for the dictionary grounder; default: the pairs of Multiverse."
        ),
    ] = None
    abstain: Annotated[
        bool, Option("--abstain", help="Let the lexical grounder answer with a superclass if its candidates are close.")
    ] = False
    alignment: AlignmentFile = None
    class_sizes: Annotated[
        Path | None,
        Option("--class-sizes", help="CSV file of class sizes for the volume grounder; default: the built-in table."),
    ] = None
    regime: Annotated[
        str, Option("--regime", help="Naming regime: semantic, abbreviated, opaque or opaque-anonymous.")
    ] = "semantic"
    evidence: Annotated[
        str | None,
        Option(
            "--evidence",
            help="Comma-separated evidence groups to use: name, geometry, position, hierarchy, asset, labels, "
            "materials, neighbours, parts; default: all.",
        ),
    ] = None
    model: ModelOptions = field(default_factory=ModelOptions)
    review: ReviewOptions = field(default_factory=ReviewOptions)

    @property
    def naming_regime(self) -> "NamingRegime":
        """The naming regime.

        Raises:
            GroundingError: the regime is unknown.
        """
        from usd2kg.grounding import parse_regime  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        return parse_regime(self.regime)

    @property
    def evidence_groups(self) -> frozenset[str] | None:
        """The evidence groups to use; None for all.

        Raises:
            GroundingError: a group is unknown.
        """
        from usd2kg.grounding import parse_evidence  # noqa: PLC0415

        return parse_evidence(self.evidence) if self.evidence is not None else None
