"""serve_studio: run the application as an HTTP server on one project."""

import getpass
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from urllib.parse import quote

from usd2kg.endpoint.listening import open_socket
from usd2kg.errors import Usd2kgError
from usd2kg.studio.project import Project

__all__ = ["StudioOptions", "serve_studio"]


@dataclass(frozen=True)
class StudioOptions:
    """Address, allowed clients and reviewer."""

    host: str = "127.0.0.1"
    port: int = 7879
    """0 selects a free port."""
    hosts: Sequence[str] = ()
    """Host names that are served in addition to localhost and IP addresses."""
    reviewer: str | None = None
    """Name that the page suggests; None for the user's login name."""


def serve_studio(
    project: Project, options: StudioOptions, *, is_local: bool, when_ready: Callable[[str], None]
) -> None:
    """Serve the page until the process is interrupted.

    Args:
        project: the open project.
        options: address, allowed clients and reviewer.
        is_local: whether only this machine can connect, so that a random key is enough.
        when_ready: receives the address of the page when requests are answered.

    Raises:
        Usd2kgError: a source cannot be read, the extra `studio` is missing, or the port is in use.
    """
    try:
        import fast_simplification  # noqa: F401, PLC0415
        import trimesh  # noqa: F401, PLC0415

        from usd2kg.studio.access import choose_key, has_password  # noqa: PLC0415
        from usd2kg.studio.application import make_app  # noqa: PLC0415
        from usd2kg.studio.http_server import StudioServer  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise Usd2kgError(f"studio: {error.name} is not installed; run: pip install 'usd2kg[studio]'") from error
    from usd2kg.studio.app_files import read_app_files  # noqa: PLC0415
    from usd2kg.studio.session import open_session  # noqa: PLC0415

    key = choose_key(is_local=is_local)
    files = read_app_files()
    with open_socket(options.host, options.port) as socket:
        session = open_session(project)
        # Whoever reads the address below may connect before the server accepts.
        socket.listen()
        host, port = socket.getsockname()[:2]
        address = f"http://{f'[{host}]' if ':' in host else host}:{port}/"
        if not has_password():
            # A fragment is not sent to the server, so no log has it.
            address += f"#token={quote(key)}"
        app = make_app(
            session,
            files,
            key=key,
            reviewer=options.reviewer or _login_name(),
            hosts=[*options.hosts, options.host],
            when_ready=lambda: when_ready(address),
        )
        try:
            StudioServer(app).run(sockets=[socket])
        finally:
            session.close()


def _login_name() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError):
        return "reviewer"
