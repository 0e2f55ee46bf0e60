"""Options of commands that run untrusted queries."""

from typing import Annotated

from typer import Option

__all__ = ["QueryTimeLimit"]

QueryTimeLimit = Annotated[float, Option("--time-limit", min=0.1, help="Seconds after which a query is cancelled.")]
