"""Removable in-memory sublayers of the session layer of an open stage, each with one kind of content."""

from collections.abc import Iterator, Mapping

from pxr import Sdf, Usd

from usd2kg.errors import OutputError

__all__ = ["add_to_session", "is_marked", "mark_layer", "provenance_of", "remove_from_session"]

_MARK = "usd2kg"
"""Key in `customLayerData` that identifies layers of usd2kg."""


def mark_layer(layer: Sdf.Layer, content: str, provenance: Mapping[str, str]) -> None:
    """Mark a layer in its metadata as written by usd2kg, with the kind of its content."""
    layer.customLayerData = {**layer.customLayerData, _MARK: {"content": content, **provenance}}


def is_marked(layer: Sdf.Layer) -> bool:
    """Return whether usd2kg wrote a layer."""
    return _MARK in layer.customLayerData


def provenance_of(layer: Sdf.Layer, content: str) -> Mapping[str, str]:
    """Return the provenance of a layer with some content; empty for any other layer."""
    found = layer.customLayerData.get(_MARK)
    return {k: str(v) for k, v in found.items()} if isinstance(found, dict) and found.get("content") == content else {}


def add_to_session(stage: Usd.Stage, opinions: Sdf.Layer, content: str) -> None:
    """Add the prims of a layer to an open stage, in place of earlier opinions with the same content.

    They go into a layer in memory that becomes the strongest sublayer of the session layer. The root layer, its
    sublayers and what others authored in the session layer stay as they are, and nothing is written to a file.

    Args:
        stage: the open stage.
        opinions: the prims to add, in a layer that is not part of the stage.
        content: what the opinions are about, such as `labels`.

    Raises:
        OutputError: the stage has no session layer.
    """
    session = stage.GetSessionLayer()
    if session is None:
        source = stage.GetRootLayer().identifier
        raise OutputError(f"{source}: the stage was opened without a session layer; open it with one")
    remove_from_session(stage, content)
    target = Sdf.Layer.CreateAnonymous(f"usd2kg_{content}")
    mark_layer(target, content, {})
    # An empty sublayer does not make OpenUSD compose the whole stage again, one with prims does.
    session.subLayerPaths.insert(0, target.identifier)
    with Sdf.ChangeBlock():
        for prim in opinions.rootPrims:
            Sdf.CreatePrimInLayer(target, prim.path)
            Sdf.CopySpec(opinions, prim.path, target, prim.path)


def remove_from_session(stage: Usd.Stage, content: str) -> bool:
    """Remove the layer that `add_to_session` added with this content; return whether there was one."""
    session = stage.GetSessionLayer()
    found = [] if session is None else list(_layers_with(session, content))
    for layer in found:
        with Sdf.ChangeBlock():
            for prim in list(layer.rootPrims):
                del layer.rootPrims[prim.name]
        session.subLayerPaths.remove(layer.identifier)
    return bool(found)


def _layers_with(session: Sdf.Layer, content: str) -> Iterator[Sdf.Layer]:
    for path in session.subLayerPaths:
        layer = Sdf.Layer.Find(path)
        # Do not remove a label file that the user added to the session.
        if layer is not None and layer.anonymous and layer.customLayerData.get(_MARK, {}).get("content") == content:
            yield layer
