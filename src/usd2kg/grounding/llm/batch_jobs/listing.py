"""list_recent_jobs: all batch jobs created at a service since a given time, by any client of the account."""

from collections.abc import AsyncIterator, Callable
from datetime import UTC, datetime
from importlib import import_module
from typing import TYPE_CHECKING, Any, NamedTuple, cast

if TYPE_CHECKING:
    from anthropic import AsyncAnthropic
    from pydantic_ai.models import Model
    from pydantic_ai.models.anthropic import AnthropicModel
    from pydantic_ai.models.google import GoogleModel
    from pydantic_ai.models.openai import OpenAIResponsesModel

__all__ = ["RecentJob", "find_status", "library_errors", "list_recent_jobs"]

_PAGE = 100
"""Jobs in an answer, the largest number that all services allow."""


class RecentJob(NamedTuple):
    """A job at a service."""

    id: str
    created: datetime
    """With time zone."""
    request_count: int | None
    """None if the service does not report it, or not yet."""


async def list_recent_jobs(provider_model: "Model[Any]", since: datetime) -> list[RecentJob]:
    """Return the jobs created since a time, given with its time zone.

    Raises:
        Exception: the request fails; one of `library_errors`.
    """
    jobs = []
    async for job in _LISTS[provider_model.system](provider_model):
        if job.created >= since:
            jobs.append(job)
        elif provider_model.system in _NEWEST_FIRST:
            break
    return jobs


async def _list_openai(provider_model: "Model[Any]") -> AsyncIterator[RecentJob]:
    client = cast("OpenAIResponsesModel", provider_model).client
    async for job in client.batches.list(limit=_PAGE):
        counts = job.request_counts
        total = counts.total if counts is not None and counts.total else None
        yield RecentJob(job.id, datetime.fromtimestamp(job.created_at, UTC), total)


async def _list_anthropic(provider_model: "Model[Any]") -> AsyncIterator[RecentJob]:
    client = cast("AsyncAnthropic", cast("AnthropicModel", provider_model).client)
    async for job in client.beta.messages.batches.list(limit=_PAGE):
        counts = job.request_counts
        total = counts.processing + counts.succeeded + counts.errored + counts.canceled + counts.expired
        yield RecentJob(job.id, job.created_at, total)


async def _list_google(provider_model: "Model[Any]") -> AsyncIterator[RecentJob]:
    client = cast("GoogleModel", provider_model).client
    async for job in await client.aio.batches.list(config={"page_size": _PAGE}):
        if job.name is not None and job.create_time is not None:
            yield RecentJob(job.name, job.create_time, None)


_LISTS: dict[str, Callable[["Model[Any]"], AsyncIterator[RecentJob]]] = {
    "openai": _list_openai,
    "anthropic": _list_anthropic,
    "google": _list_google,
}
_LIBRARIES = {"openai": "openai", "anthropic": "anthropic", "google": "google.genai.errors"}
"""Modules with the exceptions of the libraries."""
_NEWEST_FIRST = ("openai", "anthropic")
"""Services whose list begins with the newest job."""


def library_errors(system: str) -> tuple[type[Exception], ...]:
    """Return the exceptions of the library of a service, which pydantic-ai converts except in `list_recent_jobs`."""
    import httpx2  # noqa: PLC0415 - the extra may be missing

    return import_module(_LIBRARIES[system]).APIError, httpx2.TransportError


def find_status(error: Exception) -> int | None:
    """Return the HTTP status in an exception of `library_errors`; None if there was no response."""
    status = getattr(error, "status_code", None) or getattr(error, "code", None)
    return status if isinstance(status, int) else None
