"""usd2kg graph: pictures of a graph."""

from pathlib import Path
from typing import Annotated

import typer

from usd2kg.cli.options import GraphPlace, SceneName
from usd2kg.cli.output import talk
from usd2kg.errors import GraphError, OutputError
from usd2kg.files import check_writable, write_whole

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, help="Draw graphs.")


@app.callback()
def _group() -> None:
    """Keep `draw` a command of its own while it is the only one."""


@app.command("draw")
def draw(
    graph: GraphPlace,
    thing: Annotated[
        str | None,
        typer.Argument(metavar="[OBJECT]", help="Label, class or prim path of one object; default: the whole room."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="SVG file to write; default: GRAPH.svg here.")
    ] = None,
    scene: SceneName = None,
) -> None:
    """Draw what stands on and in what in a room, or one object with its surroundings, as SVG."""
    # The name of a file, of a scene in a store, or of the store.
    name = Path((scene or graph).rstrip("/#")).stem
    target = output or Path(f"{name}.svg")
    if target.suffix.lower() != ".svg":
        raise OutputError(f"{target}: pictures of graphs are SVG files, expected a name ending in .svg")
    check_writable(target)
    from usd2kg.graph.picture import draw_room, draw_surroundings  # noqa: PLC0415
    from usd2kg.graph.stores import open_graph  # noqa: PLC0415

    store = open_graph(graph, scene)
    if thing is None:
        picture = draw_room(store, name)
    else:
        found = store.find(thing)
        if len(found) > 1:
            raise GraphError(
                f"{thing!r} means {len(found)} objects; expected one, by its prim path: "
                f"usd2kg query {graph} where is {thing}"
            )
        picture = draw_surroundings(store, found[0].value, f"{thing} in {name}")
    write_whole(target, picture.encode("utf-8"))
    talk(f"written to {target}")
