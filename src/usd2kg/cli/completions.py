"""usd2kg completions: export and import of cached completions."""

from pathlib import Path
from typing import Annotated

import typer
from typer import Argument

from usd2kg.cli.options.model import CompletionCacheFile
from usd2kg.cli.output import notify

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help="Share the completions of language models.")


@app.command("export")
def export_completions(
    recording: Annotated[
        Path, Argument(help="JSON Lines file to write, a prompt and completion a line; compressed if it ends in .gz.")
    ],
    completions: CompletionCacheFile = None,
) -> None:
    """Write all cached completions to a recording, which others can replay without keys."""
    from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path  # noqa: PLC0415

    with CompletionCache(completions or default_cache_path()) as cache:
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
