"""The options of language models."""

from dataclasses import dataclass, field, replace
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.errors import GroundingError

if TYPE_CHECKING:
    from usd2kg.grounding.llm.factory import LLMSettings

__all__ = [
    "MODEL_NAMES",
    "CompletionCacheFile",
    "ModelName",
    "ModelOptions",
    "ObjectsPerPrompt",
    "RequestLimits",
    "RequestOptions",
    "Temperature",
    "Thinking",
]

MODEL_NAMES = (
    "google:NAME, anthropic:NAME, openai:NAME, openai:NAME@URL for a server with OpenAI's protocol, azure:DEPLOYMENT, "
    "bedrock:MODEL, or gguf:FILE for local weights"
)
"""Forms of a model string, for help texts."""

ModelName = Annotated[
    str | None, Option("--model", help=f"Language model to ask: {MODEL_NAMES}; default: none, offline.")
]
CompletionCacheFile = Annotated[
    Path | None,
    Option("--completions", help="Cache of completions; default: $USD2KG_CACHE, otherwise in the user's cache folder."),
]
ObjectsPerPrompt = Annotated[
    int | None,
    Option(
        "--objects-per-prompt",
        min=1,
        help="Objects or concepts per prompt; default: 1, or 40 for llm-concept.",
    ),
]
Temperature = Annotated[
    float | None,
    Option("--temperature", min=0, max=2, help="Sampling temperature; default: 0, or 0.7 with several samples."),
]
Thinking = Annotated[bool, Option("--thinking", help="Turn on the model's own reasoning.")]


@dataclass(frozen=True)
class RequestLimits(OptionBundle):
    """Limits, cache and replay of the requests to a language model."""

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
    threads: Annotated[int, Option("--threads", min=1, max=1024, help="Processor threads of gguf:FILE.")] = 1
    requests_per_minute: Annotated[
        int | None, Option("--requests-per-minute", min=1, help="Requests per minute; default: no limit.")
    ] = None
    completions: CompletionCacheFile = None
    replay: Annotated[
        bool, Option("--replay", help="Use cached completions only; needs no key and sends no request.")
    ] = False
    batch: Annotated[
        bool,
        Option(
            "--batch",
            help="Submit the prompts as a batch job, at half the price, and wait up to a day for the answers; the same "
            "command resumes the wait.",
        ),
    ] = False

    @property
    def dollars(self) -> Decimal | None:
        """The budget in US dollars."""
        return Decimal(str(self.budget)) if self.budget is not None else None

    def settings(self, model: str) -> "LLMSettings":
        """Return the settings of a model string, with defaults for prompts and sampling."""
        from usd2kg.grounding.llm.factory import LLMSettings  # noqa: PLC0415 - heavy

        return LLMSettings(
            model,
            token_budget=self.token_budget,
            price=self.price,
            budget=self.dollars,
            concurrency=self.concurrency,
            threads=self.threads,
            requests_per_minute=self.requests_per_minute,
            completions=self.completions,
            is_replayed=self.replay,
            is_batched=self.batch,
        )

    def check_without_model(self, how_to_name_one: str = "name one with --model MODEL") -> None:
        """Check that no option is given: all of them have an effect on language models only.

        Raises:
            GroundingError: one is given.
        """
        for option in self.changed_options():
            raise GroundingError(f"{option} needs a language model; {how_to_name_one}")


@dataclass(frozen=True)
class RequestOptions(RequestLimits):
    """Request options of a command with a single input."""

    refresh: Annotated[bool, Option("--refresh", help="Request new completions instead of using cached ones.")] = False
    dry_run: Annotated[
        bool, Option("--dry-run", help="Print the prompts and their estimated tokens; send no request.")
    ] = False

    def settings(self, model: str) -> "LLMSettings":
        """Return the settings of a model string, with defaults for prompts and sampling."""
        return replace(super().settings(model), is_refreshed=self.refresh)


@dataclass(frozen=True)
class ModelOptions(OptionBundle):
    """Prompts and sampling of a language model, and its requests."""

    output_options = frozenset({"write_alignment"})

    objects_per_prompt: ObjectsPerPrompt = None
    class_tree: Annotated[
        bool, Option("--class-tree", help="List the classes in the prompt as a tree instead of alphabetically.")
    ] = False
    thinking: Thinking = False
    each_object: Annotated[
        bool, Option("--each-object", help="Ask about each object; default: once for objects with the same evidence.")
    ] = False
    more_evidence: Annotated[
        bool, Option("--more-evidence", help="Add asset, labels, materials, parts and documentation to the prompt.")
    ] = False
    thumbnails: Annotated[bool, Option("--thumbnails", help="Add two pictures of each object to the prompt.")] = False
    shuffle: Annotated[
        int | None, Option("--shuffle", help="Seed to shuffle the classes in the prompt; default: not shuffled.")
    ] = None
    shortlist: Annotated[
        int | None,
        Option("--shortlist", min=1, help="Number of classes to offer, by the lexical grounder's rank; default: all."),
    ] = None
    candidates_first: Annotated[
        bool,
        Option("--candidates-first", help="List the classes of --shortlist by rank; default: in alphabetical order."),
    ] = False
    cascade: Annotated[
        float | None,
        Option(
            "--cascade",
            min=0,
            max=1,
            help="Ask only about objects below this confidence of the lexical grounder; default: all objects.",
        ),
    ] = None
    samples: Annotated[
        int, Option("--samples", min=1, help="Completions per prompt; the majority class is the answer.")
    ] = 1
    first_sample: Annotated[
        int, Option("--first-sample", min=0, help="Number of the first sample, to draw new samples in repeated runs.")
    ] = 0
    temperature: Temperature = None
    calibration: Annotated[
        Path | None,
        Option(
            "--calibration", help="Calibration written by usd2kg eval calibrate; default: confidence is uncalibrated."
        ),
    ] = None
    examples: Annotated[
        int, Option("--examples", min=0, help="Number of decisions from --decisions to show in the prompt as examples.")
    ] = 0
    write_alignment: Annotated[
        Path | None,
        Option("--write-alignment", help="SSSOM file to write: the answers of llm-concept, for --alignment."),
    ] = None
    requests: RequestOptions = field(default_factory=RequestOptions)

    def settings(self, grounder: str) -> "LLMSettings":
        """Return the settings for a grounder name, a strategy and a model like `llm-B:MODEL`.

        Raises:
            GroundingError: the name has another form.
        """
        from usd2kg.grounding.llm.factory import parse_llm_name  # noqa: PLC0415 - heavy

        model, strategy = parse_llm_name(grounder)
        return replace(
            self.requests.settings(model),
            strategy=strategy,
            objects_per_prompt=self.objects_per_prompt,
            is_tree=self.class_tree,
            is_thinking=self.thinking,
            is_each_object=self.each_object,
            has_more_evidence=self.more_evidence,
            shuffle_seed=self.shuffle,
            shortlist=self.shortlist,
            has_candidates_first=self.candidates_first,
            samples=self.samples,
            first_sample=self.first_sample,
            temperature=self.temperature,
            calibration=self.calibration,
        )

    def check_without_model(self) -> None:
        """Check that no option is given: all of them have an effect on language models only.

        Raises:
            GroundingError: one is given.
        """
        for option in self.changed_options():
            raise GroundingError(f"{option} needs a language model; name one with --grounder llm-B:MODEL")
