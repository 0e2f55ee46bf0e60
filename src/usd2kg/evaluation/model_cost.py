"""ModelCost: cost of the completions behind one result, and counts of unusable completions."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from decimal import Decimal
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from usd2kg.grounding.llm.metered_client import RunReport

__all__ = ["ModelCost"]


@dataclass(frozen=True, slots=True)
class ModelCost:
    """Counts of one result as if no completion had been cached, so that they do not depend on earlier runs."""

    objects: int
    """Objects that the model was asked about: in a cascade, those with a low confidence of the first grounder."""
    prompts: int
    """Distinct prompts, without repairs."""
    completions: int
    """Completions of prompts and repairs."""
    cached: int
    """Completions from the cache, which cost nothing in this run."""
    repairs: int
    """Prompts that were repeated because an answer was unreadable."""
    degenerate: int
    """Completions that are empty, repeat themselves or were truncated."""
    hallucinated_objects: int
    """Objects without a class because the last answer names a class that was not offered."""
    degenerate_objects: int
    """Objects without a class because the last completion is degenerate."""
    input_tokens: int
    output_tokens: int
    estimated_tokens: int
    """The part of these tokens that is estimated because the server did not report it."""
    dollars: Decimal | None
    """US dollars for these tokens; None if the price of the model is unknown."""
    paid: Decimal | None
    """US dollars for the completions that were not cached."""
    keys: tuple[str, ...]
    """Cache keys of the completions, sorted."""

    def as_json(self) -> dict[str, Any]:
        """Return the counts as plain data, with dollars as decimal text."""
        return {
            **asdict(self),
            "dollars": _text(self.dollars),
            "paid": _text(self.paid),
            "keys": list(self.keys),
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> "ModelCost":
        """Return the counts that `as_json` wrote."""
        return cls(
            **{
                **data,
                "dollars": _decimal(data["dollars"]),
                "paid": _decimal(data["paid"]),
                "keys": tuple(data["keys"]),
            }
        )

    @classmethod
    def from_report(cls, report: "RunReport") -> "ModelCost":
        """Return the counts of a report that covers one result."""
        from usd2kg.grounding.llm.answers import Defect  # noqa: PLC0415 - slow to import

        usage = report.usage + report.cached_usage
        has_price = report.price is not None and report.cached_price is not None
        return cls(
            objects=report.objects,
            prompts=report.prompts,
            completions=report.completions + report.cached,
            cached=report.cached,
            repairs=report.repairs,
            degenerate=report.degenerate,
            hallucinated_objects=report.defects[Defect.HALLUCINATED],
            degenerate_objects=report.defects[Defect.DEGENERATE],
            input_tokens=usage.input_tokens,
            output_tokens=usage.output_tokens,
            estimated_tokens=usage.estimated_tokens,
            dollars=(report.price or Decimal(0)) + (report.cached_price or Decimal(0)) if has_price else None,
            paid=report.price,
            keys=tuple(sorted(report.keys)),
        )


def _text(dollars: Decimal | None) -> str | None:
    return None if dollars is None else str(dollars)


def _decimal(text: str | None) -> Decimal | None:
    return None if text is None else Decimal(text)
