"""usd2kg graph: pictures of a graph."""

from pathlib import Path
from typing import Annotated

import typer

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
    graph: Annotated[Path, typer.Argument(metavar="GRAPH", help="A graph that usd2kg build wrote.")],
    thing: Annotated[
        str | None,
        typer.Argument(metavar="[OBJECT]", help="Label, class or prim path of one object; default: the whole room."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="SVG or PNG file to write; default: GRAPH.svg here.")
    ] = None,
) -> None:
    """Draw what stands on and in what in a room, or one object with its surroundings, as SVG or PNG."""
    target = output or Path(f"{graph.stem}.svg")
    if target.suffix.lower() not in {".svg", ".png"}:
        raise OutputError(f"{target}: pictures of graphs are SVG or PNG, expected a name ending in .svg or .png")
    check_writable(target)
    from usd2kg.graph import load_graph  # noqa: PLC0415
    from usd2kg.graph.picture import draw_room, draw_surroundings, to_png  # noqa: PLC0415

    store = load_graph(graph)
    if thing is None:
        picture = draw_room(store, graph.stem)
    else:
        found = store.find(thing)
        if len(found) > 1:
            raise GraphError(
                f"{thing!r} means {len(found)} objects; expected one, by its prim path: "
                f"usd2kg query {graph} where is {thing}"
            )
        picture = draw_surroundings(store, found[0].value, f"{thing} in {graph.stem}")
    write_whole(target, to_png(picture) if target.suffix.lower() == ".png" else picture.encode("utf-8"))
    talk(f"written to {target}")
