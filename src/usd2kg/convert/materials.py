"""Author the materials of a source file as UsdPreviewSurface, each once."""

from dataclasses import dataclass

from pxr import Gf, Sdf, Usd, UsdShade

from usd2kg.convert.prims import PrimAuthor

__all__ = ["MaterialAuthor", "SurfaceMaterial"]


@dataclass(frozen=True)
class SurfaceMaterial:
    """A named material; a value is None if the source does not state it as a constant."""

    name: str
    color: tuple[float, float, float] | None = None
    """Linear RGB."""
    opacity: float | None = None
    roughness: float | None = None
    metallic: float | None = None


class MaterialAuthor:
    """Defines materials in a scope below the default prim, and binds prims to them."""

    def __init__(self, author: PrimAuthor, root: str) -> None:
        self._author = author
        self._root = root
        self._scope: str | None = None
        self._made: dict[SurfaceMaterial, UsdShade.Material] = {}

    def bind(self, prim: Usd.Prim, material: SurfaceMaterial) -> None:
        """Bind a prim to a material."""
        if material not in self._made:
            self._made[material] = self._define(material)
        UsdShade.MaterialBindingAPI.Apply(prim).Bind(self._made[material])

    def _define(self, material: SurfaceMaterial) -> UsdShade.Material:
        if self._scope is None:
            self._scope = str(self._author.define(self._root, "Materials", "Scope").GetPath())
        made = UsdShade.Material(self._author.define(self._scope, material.name, "Material"))
        shader = UsdShade.Shader(self._author.define(str(made.GetPath()), "Surface", "Shader"))
        shader.CreateIdAttr("UsdPreviewSurface")
        if material.color is not None:
            shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*material.color))
        for name in ("opacity", "roughness", "metallic"):
            value = getattr(material, name)
            if value is not None:
                shader.CreateInput(name, Sdf.ValueTypeNames.Float).Set(value)
        made.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        return made
