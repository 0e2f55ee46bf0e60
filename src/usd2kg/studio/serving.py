"""serve_studio: run the application as an HTTP server on one project."""

import getpass
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import quote

from usd2kg.endpoint.listening import Address, open_socket, url_of
from usd2kg.errors import Usd2kgError
from usd2kg.progress import show_steps
from usd2kg.studio.project import Project, ProjectSources, open_project

if TYPE_CHECKING:
    from usd2kg.studio.session import StudioSession

__all__ = ["serve_studio"]


def serve_studio(
    folder: Path,
    sources: ProjectSources | None,
    address: Address,
    *,
    reviewer: str | None = None,
    compared: Path | None = None,
    when_ready: Callable[[str], None],
) -> None:
    """Open or make a project and serve its page until the process is interrupted.

    Args:
        folder: the folder of the project.
        sources: what to review; None to take those of the project.
        address: where to listen. If other machines can connect, the environment must have a password.
        reviewer: name that the page suggests; None for the user's login name.
        compared: stage, graph or mapping to compare with; None for no comparison.
        when_ready: receives the URL of the page when requests are answered.

    Raises:
        Usd2kgError: the project or a source cannot be opened, the extra `studio` is missing, or the port is in use.
    """
    try:
        import fast_simplification  # noqa: F401, PLC0415
        import PIL  # noqa: F401, PLC0415

        from usd2kg.studio.access import choose_key, has_password  # noqa: PLC0415
        from usd2kg.studio.application import make_app  # noqa: PLC0415
        from usd2kg.studio.studio_server import StudioServer  # noqa: PLC0415
    except ModuleNotFoundError as error:
        raise Usd2kgError(f"studio: {error.name} is not installed; run: pip install 'usd2kg[studio]'") from error
    from usd2kg.endpoint.app_files import read_app_files  # noqa: PLC0415
    from usd2kg.studio.other_version import read_other_version  # noqa: PLC0415

    key = choose_key(is_local=address.is_local)
    files = read_app_files("index.html")
    with (
        open_socket(address) as socket,
        open_project(folder, sources) as project,
        closing(_open_with_progress(project)) as session,
    ):
        other = None if compared is None else read_other_version(compared, project.sources, session.tbox)
        # Whoever reads the URL below may connect before the server accepts.
        socket.listen()
        # A fragment is not sent to the server, so no log has it.
        url = url_of(socket) + ("" if has_password() else f"#token={quote(key)}")
        app = make_app(
            session,
            files,
            key=key,
            reviewer=reviewer or _login_name(),
            hosts=address.served_names,
            other=other,
            when_ready=lambda: when_ready(url),
        )
        StudioServer(app).run(sockets=[socket])


def _login_name() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError):
        return "reviewer"


def _open_with_progress(project: Project) -> "StudioSession":
    from usd2kg.studio.open_session import open_session  # noqa: PLC0415 - loads OpenUSD

    with show_steps("read", "ground", "relate"):
        return open_session(project)
