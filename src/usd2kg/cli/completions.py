"""usd2kg completions: what language models said, to keep and to hand on."""

from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.model_options import CompletionsFile
from usd2kg.cli.output import talk

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help="Keep and hand on what language models said.")


@app.command("export")
def export_command(
    recording: Annotated[Path, typer.Argument(help="File to write, JSON Lines: one prompt and its completion a line.")],
    completions: CompletionsFile = None,
) -> None:
    """Write all completions that are kept as a recording that others can replay without keys."""
    from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path  # noqa: PLC0415

    with CompletionCache(completions or default_cache_path()) as cache:
        talk(f"{cache.export_recording(recording)} completions written to {recording}")


@app.command("import")
def import_command(
    recording: Annotated[Path, typer.Argument(help="A recording, as usd2kg completions export writes it.")],
    completions: CompletionsFile = None,
) -> None:
    """Add the completions of a recording to those that are kept."""
    from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path  # noqa: PLC0415

    with CompletionCache(completions or default_cache_path()) as cache:
        talk(f"{cache.import_recording(recording)} new completions from {recording}")
