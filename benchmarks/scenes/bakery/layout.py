"""Groups and objects of the stage: Y up, centimetres; an object is written when it is placed."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from pxr import Kind, Sdf, Usd, UsdGeom

from benchmarks.scenes.bakery.forms import NONE, Piece, Triple
from benchmarks.scenes.prims import draw, write_instance, write_mesh, write_root, write_transform, write_unit_gprim

__all__ = ["Area", "new_stage", "save"]

ROOT = Sdf.Path("/World")
LIBRARY = Sdf.Path("/_Library")
SLIPS = (0.0, 0.0, 0.05, 0.1, 0.15, 0.2, -0.05, -0.1, -0.15, -0.2)
"""Centimetres by which a standing thing is too high or too low; its path draws one of them."""


def new_stage() -> "Area":
    """Return the root of a new stage."""
    stage = Usd.Stage.CreateInMemory()
    write_root(stage, ROOT, up="Y", unit=0.01)
    return Area(stage, ROOT)


def save(area: "Area", out: Path) -> int:
    """Write the stage to a file; return the number of its objects."""
    area.stage.GetRootLayer().Export(str(out))
    return sum(Usd.ModelAPI(prim).GetKind() == Kind.Tokens.component for prim in area.stage.Traverse())


class Area:
    """A group with a transform of its own, in whose frame objects are placed."""

    def __init__(self, stage: Usd.Stage, path: Sdf.Path) -> None:
        self.stage = stage
        self.path = path

    def area(self, name: str, at: Triple = NONE, turn: float = 0.0) -> "Area":
        """Add a group below this one, turned by degrees about the vertical axis."""
        path = self.path.AppendChild(name)
        xform = UsdGeom.Xform.Define(self.stage, path)
        Usd.ModelAPI(xform.GetPrim()).SetKind(Kind.Tokens.group)
        write_transform(xform, at, (0, turn, 0), (1, 1, 1))
        return Area(self.stage, path)

    def stand(
        self, name: str, form: Piece | Sequence[Piece], at: Triple = NONE, rot: Triple = NONE, like: str = ""
    ) -> None:
        """Add an object that was put there by hand: a little too high or too low. For `like`, see `fix`."""
        x, y, z = at
        self.fix(name, form, (x, y + draw(str(self.path.AppendChild(name)), SLIPS), z), rot, like)

    def fix(
        self, name: str, form: Piece | Sequence[Piece], at: Triple = NONE, rot: Triple = NONE, like: str = ""
    ) -> None:
        """Add an object exactly there.

        Args:
            name: its name in the group.
            form: what it is made of; one mesh is the object itself.
            at: where its origin is.
            rot: degrees by which it is turned about x, then y, then z.
            like: the name of a thing in the library of which it is an instance; the first one defines it.
        """
        path = self.path.AppendChild(name)
        if self.stage.GetPrimAtPath(path):
            raise ValueError(f"{path} is placed twice")
        pieces = [form] if isinstance(form, Piece) else list(form)
        if like:
            write = partial(_write_pieces, self.stage, pieces=pieces)
            prim = write_instance(self.stage, path, LIBRARY.AppendChild(like), write)
        elif len(pieces) == 1 and pieces[0].points is not None:
            prim = write_mesh(self.stage, path, pieces[0].points, pieces[0].faces).GetPrim()
        else:
            prim = UsdGeom.Xform.Define(self.stage, path).GetPrim()
            _write_pieces(self.stage, path, pieces)
        write_transform(UsdGeom.Xformable(prim), at, rot, (1, 1, 1))
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)


def _write_pieces(stage: Usd.Stage, path: Sdf.Path, pieces: Sequence[Piece]) -> None:
    for number, piece in enumerate(pieces, start=1):
        child = path.AppendChild(f"geo_{number:02}")
        if piece.points is not None:
            write_mesh(stage, child, piece.points, piece.faces)
        else:
            gprim = write_unit_gprim(stage, child, piece.kind, UsdGeom.Tokens.y)
            write_transform(gprim, piece.at, piece.rot, piece.scale)
