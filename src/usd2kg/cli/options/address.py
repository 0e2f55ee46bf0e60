"""The options for the address of a server."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from typer import Option

from usd2kg.cli.options.bundles import OptionBundle

if TYPE_CHECKING:
    from usd2kg.endpoint import Address

__all__ = ["AddressOptions", "Port"]

Port = Annotated[int, Option("--port", min=0, max=65535, help="Port; 0 chooses a free one.")]


@dataclass(frozen=True)
class AddressOptions(OptionBundle):
    """Address and names of the server; the default port depends on the command."""

    host: Annotated[str, Option("--host", help="Address to listen on; 127.0.0.1 accepts local connections only.")] = (
        "127.0.0.1"
    )
    allow_host: Annotated[
        list[str] | None,
        Option(
            "--allow-host",
            metavar="NAME",
            help="Host name accepted in requests in addition to localhost. Repeatable; default: none.",
        ),
    ] = None

    def address(self, port: int) -> "Address":
        """Return the address with a port."""
        from usd2kg.endpoint import Address  # noqa: PLC0415 - loads OpenUSD, too slow for --help

        return Address(self.host, port, tuple(self.allow_host or ()))
