"""usd2kg studio: look at a scene and review its classes in the browser."""

import signal
import webbrowser
from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from usd2kg.cli.options.address import AddressOptions, Port
from usd2kg.cli.options.bundles import expand_bundles
from usd2kg.cli.options.common import BaseIri, OntologyFile
from usd2kg.cli.options.grounding import AlignmentFile
from usd2kg.cli.options.review import Reviewer
from usd2kg.cli.options.stage import StageOptions
from usd2kg.cli.output import notify
from usd2kg.errors import OutputError

__all__ = ["studio_command"]


@expand_bundles
def studio_command(
    target: Annotated[
        Path,
        Argument(
            metavar="SCENE|FOLDER", help="USD stage, a file that usd2kg convert reads, or the folder of a project."
        ),
    ],
    reading: StageOptions,
    where: AddressOptions,
    ontology: OntologyFile = None,
    mapping: Annotated[
        Path | None,
        Option(
            "--mapping",
            help="Mapping to review, by any grounder: usd2kg ground -o MAPPING.json; default: by the lexical grounder.",
        ),
    ] = None,
    alignment: AlignmentFile = None,
    base: BaseIri = None,
    project: Annotated[
        Path | None,
        Option("--project", help="Folder of decisions and outputs; default: SCENE.studio in the current folder."),
    ] = None,
    reviewer: Reviewer = None,
    port: Port = 7879,
    no_browser: Annotated[bool, Option("--no-browser", help="Do not open the browser; print the address.")] = False,
) -> None:
    """Open a scene in the browser to look at it, review classes, ask and export, until Ctrl+C.

    The page suggests --reviewer, or else the login name, and can change it.
    With a --host other than this machine, a password in USD2KG_STUDIO_PASSWORD is needed.
    """
    from usd2kg.studio import ProjectSources, serve_studio  # noqa: PLC0415 - OpenUSD

    sources = None
    if target.is_dir():
        if project is not None:
            raise OutputError(f"--project {project}: {target} is a project already; name one of them")
        folder = target
    else:
        folder = project or Path(f"{target.stem}.studio")
        sources = ProjectSources(target, ontology, mapping, alignment, base, reading.read_options())

    def report(url: str) -> None:
        notify(f"studio at {url}")
        notify(f"decisions and outputs in {folder}")
        if not no_browser:
            webbrowser.open(url)

    # Service managers stop it with SIGTERM. As after Ctrl+C, the outputs are written first.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        serve_studio(folder, sources, where.address(port), reviewer=reviewer, when_ready=report)
    except KeyboardInterrupt:
        notify("stopped")
