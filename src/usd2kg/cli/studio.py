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
from usd2kg.files import stem_of

__all__ = ["studio_command"]


@expand_bundles
def studio_command(
    target: Annotated[
        Path,
        Argument(
            metavar="SCENE|GRAPH|FOLDER",
            help="USD stage, a file that usd2kg convert reads, a graph of usd2kg build, or the folder of a project.",
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
    second_mapping: Annotated[
        Path | None,
        Option(
            "--second-mapping",
            help="Mapping by another grounder; the queue can begin with the objects about which the two disagree.",
        ),
    ] = None,
    alignment: AlignmentFile = None,
    base: BaseIri = None,
    project: Annotated[
        Path | None,
        Option(
            "--project",
            help="Folder of decisions and outputs; default: SCENE.studio or GRAPH.ttl.studio in the current folder.",
        ),
    ] = None,
    compare: Annotated[
        Path | None,
        Option(
            "--compare",
            metavar="OTHER",
            help="Show the changes from OTHER: another version as a stage or graph, or a mapping of another run or "
            "grounder (grounding.json, SSSOM).",
        ),
    ] = None,
    reviewer: Reviewer = None,
    port: Port = 7879,
    no_browser: Annotated[bool, Option("--no-browser", help="Do not open the browser; print the address.")] = False,
) -> None:
    """Open a scene or its graph in the browser to look at it, review classes, ask and export, until Ctrl+C.

    The page suggests --reviewer, or else the login name, and can change it.
    With a --host other than this machine, a password in USD2KG_STUDIO_PASSWORD is needed.
    """
    from usd2kg.convert import is_stage  # noqa: PLC0415
    from usd2kg.studio import PROJECT_FILE, ProjectSources, is_graph, serve_studio  # noqa: PLC0415 - OpenUSD

    sources = None
    if target.is_dir() and ((target / PROJECT_FILE).exists() or not is_stage(target)):
        if project is not None:
            raise OutputError(f"--project {project}: {target} is a project already; name one of them")
        folder = target
    else:
        # A graph often has the name of its stage, which may have a project of its own.
        folder = project or Path(f"{target.name if is_graph(target) else stem_of(target)}.studio")
        sources = ProjectSources(target, ontology, mapping, second_mapping, alignment, base, reading.read_options())

    def report(url: str) -> None:
        notify(f"studio at {url}")
        notify(f"decisions and outputs in {folder}")
        if not no_browser:
            webbrowser.open(url)

    # Service managers stop the server with SIGTERM. As after Ctrl+C, the outputs are written first.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        serve_studio(folder, sources, where.address(port), reviewer=reviewer, compared=compare, when_ready=report)
    except KeyboardInterrupt:
        notify("stopped")
