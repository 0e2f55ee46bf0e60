"""usd2kg completions: export and import of cached completions, and open batch jobs."""

from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer
from typer import Argument

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.options.model import CompletionCacheFile
from usd2kg.cli.output import count_noun, emit, notify, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.errors import GroundingError

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help="Share the completions of language models.")


@app.command("export")
def export_completions(
    recording: Annotated[
        Path,
        Argument(help="JSON Lines file to write, one prompt and completion per line; compressed if it ends in .gz."),
    ],
    completions: CompletionCacheFile = None,
) -> None:
    """Write all cached completions to a recording, which others can replay without keys."""
    from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path  # noqa: PLC0415

    with CompletionCache(completions or default_cache_path(), creates=False) as cache:
        notify(f"{cache.export_recording(recording)} completions written to {recording}")


@app.command("import")
def import_completions(
    recording: Annotated[Path, Argument(help="Recording written by usd2kg completions export.")],
    completions: CompletionCacheFile = None,
) -> None:
    """Add the completions of a recording to the cache."""
    from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path  # noqa: PLC0415

    with CompletionCache(completions or default_cache_path()) as cache:
        notify(f"{cache.import_recording(recording)} new completions from {recording}")


@app.command("jobs")
def list_jobs(completions: CompletionCacheFile = None, json: JsonOutput = False) -> None:
    """List the batch jobs whose answers are not fetched yet; the command that submitted a job fetches them."""
    from usd2kg.grounding.llm.batch_jobs.journal import JobJournal  # noqa: PLC0415
    from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path  # noqa: PLC0415

    with CompletionCache(completions or default_cache_path()) as cache:
        jobs = JobJournal(cache).open_jobs()
    times = [datetime.fromtimestamp(job.recorded_s).astimezone().isoformat(timespec="seconds") for job in jobs]
    if json:
        print_json(
            [
                {"id": job.id, "model": job.model, "prompts": len(job.keys), "submitted": when}
                for job, when in zip(jobs, times, strict=True)
            ]
        )
        return
    rows = [(job.id or "unknown", job.model, str(len(job.keys)), when) for job, when in zip(jobs, times, strict=True)]
    emit(format_table(("job", "model", "prompts", "submitted"), rows))


@app.command("forget")
def forget_job(
    job: Annotated[str, Argument(metavar="JOB", help="Id of a batch job, as listed by `completions jobs`.")],
    completions: CompletionCacheFile = None,
) -> None:
    """Discard a batch job, such as one whose answers the service has deleted.

    The next run submits its prompts again and pays for them again. The job keeps running at the service.
    """
    from usd2kg.grounding.llm.batch_jobs.journal import JobJournal  # noqa: PLC0415
    from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path  # noqa: PLC0415

    with CompletionCache(completions or default_cache_path()) as cache:
        journal = JobJournal(cache)
        found = next((one for one in journal.open_jobs() if one.id == job), None)
        if found is None:
            raise GroundingError(f"batch job {job!r} is not open; expected one listed by usd2kg completions jobs")
        journal.close(found, {})
    notify(f"batch job {job} discarded, with {count_noun(len(found.keys), 'prompt')}")
