"""The options of asking a language model, which several commands take."""

from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.errors import GroundingError

if TYPE_CHECKING:
    from usd2kg.grounding.llm.settings import LLMSettings

__all__ = ["CompletionsFile", "ModelOptions"]

ObjectsPerPrompt = Annotated[
    int, typer.Option("--objects-per-prompt", min=1, help="Objects that one prompt asks about; default: 1.")
]
ClassTree = Annotated[bool, typer.Option("--class-tree", help="Show a model the classes as a tree instead of a list.")]
Thinking = Annotated[bool, typer.Option("--thinking", help="Let a model reason by itself before it answers.")]
EachObject = Annotated[
    bool, typer.Option("--each-object", help="Ask about each object, alike ones too; default: once for alike ones.")
]
TokenBudget = Annotated[
    int | None, typer.Option("--token-budget", min=1, help="Tokens after which a model is asked no more.")
]
Budget = Annotated[
    float | None, typer.Option("--budget", min=0, help="US dollars after which a model is asked no more.")
]
Price = Annotated[
    str | None,
    typer.Option(
        "--price",
        metavar="INPUT/OUTPUT",
        help="What a model's tokens cost, in US dollars per million; default: the list price, where there is one.",
    ),
]
Concurrency = Annotated[
    int, typer.Option("--concurrency", min=1, max=64, help="Prompts on their way to a model at once; default: 4.")
]
RequestsPerMinute = Annotated[
    int | None,
    typer.Option(
        "--requests-per-minute", min=1, help="Requests that a model may be sent in a minute; default: any number."
    ),
]
CompletionsFile = Annotated[
    Path | None,
    typer.Option("--completions", help="File that keeps what models said; default: $USD2KG_CACHE or the user's cache."),
]
Refresh = Annotated[bool, typer.Option("--refresh", help="Ask a model again for what it has said before.")]
MoreEvidence = Annotated[
    bool, typer.Option("--more-evidence", help="Show a model asset, labels, materials, parts and documentation too.")
]
Shuffle = Annotated[
    int | None, typer.Option("--shuffle", help="Show a model the classes in a random order with this seed.")
]
Shortlist = Annotated[
    int | None,
    typer.Option("--shortlist", min=1, help="Offer a model only so many classes that the lexical grounder likes best."),
]
Cascade = Annotated[
    float | None,
    typer.Option(
        "--cascade", min=0, max=1, help="Ask a model only where the lexical grounder is less confident than this."
    ),
]
Replay = Annotated[
    bool, typer.Option("--replay", help="Take from a model only what it has said before; ask nobody, no key needed.")
]
DryRun = Annotated[bool, typer.Option("--dry-run", help="Print the prompts for a model and their tokens; ask nobody.")]
Samples = Annotated[
    int,
    typer.Option("--samples", min=1, help="Ask a model so often about each and take the class of most; default: 1."),
]
FirstSample = Annotated[
    int, typer.Option("--first-sample", min=0, help="Number of the first sample: repeated runs take different ones.")
]
Temperature = Annotated[
    float | None, typer.Option("--temperature", min=0, max=2, help="Of a model; default: 0, with several samples 0.7.")
]
Thumbnails = Annotated[bool, typer.Option("--thumbnails", help="Show a vision model a picture of each object.")]
Calibration = Annotated[
    Path | None,
    typer.Option("--calibration", help="File by eval calibrate, that makes probabilities of a model's confidences."),
]
Decisions = Annotated[
    Path | None,
    typer.Option(
        "--decisions",
        help="What a person decided, which is not asked about again: a CSV file path,decision, or SSSOM (.tsv), of "
        "which the rows count that a person curated or reviewed.",
    ),
]
Examples = Annotated[
    int,
    typer.Option("--examples", min=0, help="So many of the --decisions are shown to a model as examples; default: 0."),
]
Queue = Annotated[
    Path | None,
    typer.Option("--queue", help="CSV file to write, for a person: the objects below --person; read by --decisions."),
]
Person = Annotated[
    float, typer.Option("--person", min=0, max=1, help="Confidence below which a person is to decide; default: 0.5.")
]


@dataclass(frozen=True)
class ModelOptions:
    """How a language model is asked, and what people decide."""

    objects_per_prompt: ObjectsPerPrompt = 1
    class_tree: ClassTree = False
    thinking: Thinking = False
    each_object: EachObject = False
    more_evidence: MoreEvidence = False
    thumbnails: Thumbnails = False
    shuffle: Shuffle = None
    shortlist: Shortlist = None
    cascade: Cascade = None
    samples: Samples = 1
    first_sample: FirstSample = 0
    temperature: Temperature = None
    calibration: Calibration = None
    decisions: Decisions = None
    examples: Examples = 0
    person: Person = 0.5
    queue: Queue = None
    token_budget: TokenBudget = None
    budget: Budget = None
    price: Price = None
    concurrency: Concurrency = 4
    requests_per_minute: RequestsPerMinute = None
    completions: CompletionsFile = None
    refresh: Refresh = False
    replay: Replay = False
    dry_run: DryRun = False

    def settings(self, grounder: str) -> "LLMSettings":
        """Return the settings for a grounder that is called `llm-B:MODEL` or the like.

        Raises:
            GroundingError: it is called otherwise.
        """
        from usd2kg.grounding.llm.settings import LLMSettings, parse_llm_name  # noqa: PLC0415 - the extra is heavy

        return LLMSettings(
            *parse_llm_name(grounder),
            objects_per_prompt=self.objects_per_prompt,
            is_tree=self.class_tree,
            is_thinking=self.thinking,
            is_each_object=self.each_object,
            has_more_evidence=self.more_evidence,
            shuffle_seed=self.shuffle,
            shortlist=self.shortlist,
            samples=self.samples,
            first_sample=self.first_sample,
            temperature=self.temperature,
            calibration=self.calibration,
            token_budget=self.token_budget,
            price=self.price,
            budget=Decimal(str(self.budget)) if self.budget is not None else None,
            concurrency=self.concurrency,
            requests_per_minute=self.requests_per_minute,
            completions=self.completions,
            is_refreshed=self.refresh,
            is_replayed=self.replay,
        )

    def refuse_without_model(self) -> None:
        """Raise an error for the first option that only a model can heed.

        Raises:
            GroundingError: there is one.
        """
        given = {
            "--dry-run": self.dry_run,
            "--cascade": self.cascade is not None,
            "--budget": self.budget is not None,
            "--price": self.price is not None,
            "--requests-per-minute": self.requests_per_minute is not None,
            "--thumbnails": self.thumbnails,
            "--examples": self.examples > 0,
        }
        for option, is_given in given.items():
            if is_given:
                raise GroundingError(f"{option} is about asking a model; say which one with --grounder llm-B:MODEL")
