"""The options of language models."""

from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.errors import GroundingError

if TYPE_CHECKING:
    from usd2kg.grounding.llm.factory import LLMSettings

__all__ = ["MODEL_NAMES", "CompletionCacheFile", "ModelOptions"]

MODEL_NAMES = (
    "google:NAME, anthropic:NAME, openai:NAME, openai:NAME@URL for a server with OpenAI's protocol, or gguf:FILE for "
    "local weights"
)
"""Forms of a model string, for help texts."""

CompletionCacheFile = Annotated[
    Path | None,
    Option("--completions", help="Cache of completions; default: $USD2KG_CACHE, else in the user's cache folder."),
]


@dataclass(frozen=True)
class ModelOptions(OptionBundle):
    """Prompts, sampling, limits and cache of a language model."""

    objects_per_prompt: Annotated[
        int, Option("--objects-per-prompt", min=1, help="Objects that one prompt asks about.")
    ] = 1
    class_tree: Annotated[
        bool, Option("--class-tree", help="List the classes in the prompt as a tree instead of alphabetically.")
    ] = False
    thinking: Annotated[bool, Option("--thinking", help="Turn on the model's own reasoning.")] = False
    each_object: Annotated[
        bool, Option("--each-object", help="Ask about each object; default: once for objects with the same evidence.")
    ] = False
    more_evidence: Annotated[
        bool, Option("--more-evidence", help="Add asset, labels, materials, parts and documentation to the prompt.")
    ] = False
    thumbnails: Annotated[bool, Option("--thumbnails", help="Add pictures of objects to the prompt.")] = False
    shuffle: Annotated[
        int | None, Option("--shuffle", help="Seed to shuffle the classes in the prompt; default: not shuffled.")
    ] = None
    shortlist: Annotated[
        int | None,
        Option("--shortlist", min=1, help="Number of classes to offer, by the lexical grounder's rank; default: all."),
    ] = None
    cascade: Annotated[
        float | None,
        Option(
            "--cascade",
            min=0,
            max=1,
            help="Ask only where the lexical grounder's confidence is lower; default: everywhere.",
        ),
    ] = None
    samples: Annotated[
        int, Option("--samples", min=1, help="Completions per prompt; the majority class is the answer.")
    ] = 1
    first_sample: Annotated[
        int, Option("--first-sample", min=0, help="Number of the first sample, to draw new samples in repeated runs.")
    ] = 0
    temperature: Annotated[
        float | None,
        Option("--temperature", min=0, max=2, help="Sampling temperature; default: 0, or 0.7 with several samples."),
    ] = None
    calibration: Annotated[
        Path | None,
        Option(
            "--calibration", help="Calibration written by usd2kg eval calibrate; default: confidence is uncalibrated."
        ),
    ] = None
    examples: Annotated[
        int, Option("--examples", min=0, help="Number of --decisions to show in the prompt as examples.")
    ] = 0
    token_budget: Annotated[
        int | None, Option("--token-budget", min=1, help="Tokens after which no request is sent; default: no limit.")
    ] = None
    budget: Annotated[
        float | None, Option("--budget", min=0, help="US dollars after which no request is sent; default: no limit.")
    ] = None
    price: Annotated[
        str | None,
        Option(
            "--price",
            metavar="INPUT/OUTPUT",
            help="US dollars per million tokens; default: the list price, where known.",
        ),
    ] = None
    concurrency: Annotated[
        int, Option("--concurrency", min=1, max=64, help="Prompts in progress at the same time.")
    ] = 4
    requests_per_minute: Annotated[
        int | None, Option("--requests-per-minute", min=1, help="Requests per minute; default: no limit.")
    ] = None
    completions: CompletionCacheFile = None
    refresh: Annotated[bool, Option("--refresh", help="Request new completions instead of using cached ones.")] = False
    replay: Annotated[
        bool, Option("--replay", help="Use cached completions only; needs no key and sends no request.")
    ] = False
    dry_run: Annotated[
        bool, Option("--dry-run", help="Print the prompts and their estimated tokens; send no request.")
    ] = False

    def settings(self, grounder: str) -> "LLMSettings":
        """Return the settings for a grounder name, a strategy and a model like `llm-B:MODEL`.

        Raises:
            GroundingError: the name has another form.
        """
        from usd2kg.grounding.llm.factory import LLMSettings, parse_llm_name  # noqa: PLC0415 - heavy

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

    def check_without_model(self) -> None:
        """Check that no option is given that has an effect on language models only.

        Raises:
            GroundingError: one is given.
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
                raise GroundingError(f"{option} needs a language model; name one with --grounder llm-B:MODEL")
