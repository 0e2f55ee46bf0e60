"""What people wrote and chose on a prim: variants, custom texts that carry words, materials in detail."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from usd2kg.scene.model import MaterialDetails, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.stage import UNREADABLE, read_targets, value_of
from usd2kg.words import split_identifier, words_of

__all__ = [
    "MaterialReader",
    "clean_text",
    "material_details",
    "text_attributes",
    "text_names",
    "texts_of",
    "variant_selections",
    "vector_of",
]

_T = TypeVar("_T")

_MOST_TEXTS = 20
_LONGEST_TEXT = 200
_TEXT_TYPES = frozenset({"string", "token", "string[]", "token[]"})
_TECHNICAL_NAMESPACES = frozenset(
    """
    arnold collection info inputs karma material mjc newton omni outputs physics primvars rdf ri rtx semantic
    semanticTag semantics skel state ui urdf xformOp
    """.split()
)
"""First parts of property names that steer a tool; labels have a reader of their own."""
_TECHNICAL_KEYS = frozenset("name identifier version payloadAssetDependencies userDocBrief schemaUserDocBrief".split())
"""Keys of assetInfo that are told already or say nothing; the schemas' own documentation."""
_SWITCHES = frozenset("true false yes no on off none null default auto unknown undefined nan inf".split())

_HEX = re.compile(r"(?:[a-z0-9]+:)?(?:0x)?(?=[a-f-]*[0-9])[0-9a-f-]{8,}|[0-9a-f]{16,}", re.IGNORECASE)
"""Hashes, UUIDs, colours and addresses, with or without a prefix such as `sha256:`."""
_BASE64 = re.compile(r"[A-Za-z0-9+/]{15,}={0,2}")
_PATH = re.compile(r"(?:[~.]{0,2}[/\\]|[A-Za-z]:[\\/]|@).*|\S*\\\S*|\S+/\S+/\S*|\S+\.[A-Za-z][A-Za-z0-9]{1,4}")
_URL = re.compile(r"(?:[a-z][a-z0-9+.-]*:/|www\.|mailto:|urn:|data:)\S*", re.IGNORECASE)

_BASE_COLOR = ("diffuseColor", "base_color", "baseColor", "diffuse_color_constant", "diffuse_reflection_color")
_ROUGHNESS = ("roughness", "specular_roughness", "reflection_roughness_constant", "specular_reflection_roughness")
_METALLIC = ("metallic", "metalness", "base_metalness", "metallic_constant")
_OPACITY = ("opacity", "geometry_opacity", "alpha", "opacity_constant")
"""Inputs of UsdPreviewSurface; standard_surface, open_pbr_surface, gltf_pbr (MaterialX); OmniPBR, OmniSurface (MDL)."""
_RENDER_CONTEXTS = ("", "mtlx", "mdl")
_VECTORS = (Gf.Vec3f, Gf.Vec3d, Gf.Vec3h)


def variant_selections(prim: Any) -> tuple[tuple[str, str], ...]:
    """Return (variant set, selected variant) of a prim, by name of the set; sets without a selection are left out."""
    if not prim.HasVariantSets():
        return ()
    sets = prim.GetVariantSets()
    pairs = ((str(name), str(sets.GetVariantSelection(name))) for name in sorted(sets.GetNames()))
    return tuple((name, selection) for name, selection in pairs if selection)


def text_attributes(prim: Any, time: Any = None) -> tuple[tuple[str, str], ...]:
    """Return (name, text) of what somebody wrote on a prim beyond the schemas: at most 20, each text once.

    Attributes of type string or token (lists are joined) by name, then `customData:<key>`, then `assetInfo:<key>`.
    Kept are texts of 2 to 200 characters with words; paths, URLs, numbers, switches, hashes and encoded data are not.

    Args:
        prim: the prim, an instance proxy too.
        time: time code; None for the earliest.
    """
    texts: dict[str, str] = {}
    for name, text in _texts(prim, Usd.TimeCode.EarliestTime() if time is None else time):
        cleaned = clean_text(text)
        if _carries_words(cleaned):
            texts.setdefault(cleaned, name)
    return tuple((name, text) for text, name in list(texts.items())[:_MOST_TEXTS])


def _texts(prim: Any, time: Any) -> Iterator[tuple[str, str]]:
    for name in text_names(prim, prim.GetAuthoredPropertyNames()):
        yield name, ", ".join(texts_of(prim, name, time))
    if prim.HasAuthoredCustomData():
        # Every typed prim has its schema's documentation in customData; that is not authored.
        data = {key: value for key, value in prim.GetCustomData().items() if prim.HasAuthoredCustomDataKey(key)}
        yield from _flatten("customData", data)
    if prim.HasAuthoredAssetInfo():
        yield from _flatten("assetInfo", prim.GetAssetInfo())


def text_names(prim: Any, names: Iterable[str]) -> list[str]:
    """Return those of a prim's properties that may be free text, by their names."""
    definition = prim.GetPrimDefinition()
    # Of the schemas' own attributes none is free text: purpose, visibility, orientation…
    return [name for name in names if not _is_technical(name) and not definition.GetPropertyDefinition(name)]


def _is_technical(property_name: str) -> bool:
    namespace, colon, _ = property_name.partition(":")
    return bool(colon) and (namespace in _TECHNICAL_NAMESPACES or namespace.startswith("physx"))


def _flatten(prefix: str, values: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    for key in sorted(values.keys() - _TECHNICAL_KEYS):
        value = values[key]
        if isinstance(value, Mapping):
            yield from _flatten(f"{prefix}:{key}", value)
        else:
            yield f"{prefix}:{key}", ", ".join(_as_texts(value))


def texts_of(prim: Any, attribute_name: str, time: Any) -> tuple[str, ...]:
    """Return the texts of a string or token attribute, one or a list, as authored.

    Empty where there is no such attribute, no value, another type, or text that is not UTF-8. `time` None is the
    default time.
    """
    attribute = prim.GetAttribute(attribute_name)
    if not attribute or str(attribute.GetTypeName()) not in _TEXT_TYPES:
        return ()
    try:
        return _as_texts(value_of(attribute, Usd.TimeCode.Default() if time is None else time))
    except UnicodeDecodeError:
        # The texts of a list are decoded as they are taken out of it.
        return ()


def _as_texts(value: Any) -> tuple[str, ...]:
    if isinstance(value, str):
        return (value,)
    is_list = value is not None and hasattr(value, "__len__") and not isinstance(value, bytes | Mapping)
    return tuple(item for item in value if isinstance(item, str)) if is_list else ()


def clean_text(text: str) -> str:
    """Return the text on one line, without characters that do not print (controls, changes of direction)."""
    if text.isprintable():
        return " ".join(text.split())
    return " ".join("".join(c for c in text if c.isprintable() or c.isspace()).split())


def _carries_words(text: str) -> bool:
    if not 2 <= len(text) <= _LONGEST_TEXT or text[0] in "{[<" or text.lower() in _SWITCHES:
        return False
    if any(pattern.fullmatch(text) for pattern in (_HEX, _PATH, _URL)) or _is_base64(text):
        return False
    return bool(words_of(text))


def _is_base64(text: str) -> bool:
    if not _BASE64.fullmatch(text):
        return False
    # Names split into words, encoded bytes into crumbs: of 2,000 random ones 95 in 100 stay below 0.4.
    parts = [part for part in split_identifier(text) if len(part) > 3 and part.isalpha()]
    return text.endswith("=") or sum(map(len, parts)) < 0.4 * len(text)


class MaterialReader:
    """Reads the materials of objects at one time; each material is looked into once, what instances share too."""

    def __init__(self, time: Any, *, has_purpose_bindings: bool = True) -> None:
        self._time = time
        # Without bindings for one purpose only, each purpose shows the same.
        self._purposes = ("full", "preview") if has_purpose_bindings else ("full",)
        self._details: dict[str, MaterialDetails] = {}
        self._of_shared: dict[str, MaterialDetails] = {}
        self._of_instances: dict[tuple[int, ...], tuple[str, tuple[MaterialDetails, ...]]] = {}
        self._ahead: dict[int, tuple[Any, ...]] = {}
        """id of a record → its material for each purpose, for the records that were looked at ahead."""

    def look_ahead(self, records: Iterable[PrimRecord]) -> None:
        """Find what is bound to the records that will be read next; OpenUSD does many at once in parallel."""
        shown = [
            record for record in records if _shows_material(record) and not record.has_subsets and record.twin is None
        ]
        prims = [record.prim for record in shown]
        by_purpose = (_bound_materials(prims, purpose) for purpose in self._purposes)
        self._ahead = dict(zip(map(id, shown), zip(*by_purpose, strict=True), strict=True))

    def read(self, records: list[PrimRecord]) -> tuple[MaterialDetails, ...]:
        """Return the materials that the geometry among `records` is shown with, in order of appearance.

        Bindings are resolved as UsdShade does (direct, inherited, by collection, by strength), for the purposes
        `full` and `preview`; geometry subsets are asked too. A binding to a material that does not exist gives its
        name.
        """
        root, twin = records[0], records[0].twin
        if twin is None or root.is_bound or twin.is_bound:
            return self._resolve(records)
        # What is bound within an instance is bound alike in all of them.
        key = tuple(id(record.twin) for record in records)
        instance = _instance_above(root)
        if key not in self._of_instances:
            self._of_instances[key] = (instance, self._resolve(records))
        first, materials = self._of_instances[key]
        return tuple(self._moved(material, first + "/", instance + "/") for material in materials)

    def _moved(self, material: MaterialDetails, before: str, after: str) -> MaterialDetails:
        if not material.prim_path.startswith(before):
            return material
        return replace(material, prim_path=after + material.prim_path.removeprefix(before))

    def _resolve(self, records: list[PrimRecord]) -> tuple[MaterialDetails, ...]:
        found: dict[str, MaterialDetails] = {}
        for prim, materials in (
            binding for record in records if _shows_material(record) for binding in self._bound(record)
        ):
            bound = [material for material in materials if material]
            for material in bound:
                details = self._read(material)
                found.setdefault(details.prim_path, details)
            target = None if bound else _authored_target(prim)
            if target is not None:
                found.setdefault(str(target), MaterialDetails(target.name, str(target)))
        return tuple(found.values())

    def _bound(self, record: PrimRecord) -> list[tuple[Any, tuple[Any, ...]]]:
        """Return (prim, its material for each purpose) for a record and its geometry subsets."""
        known = self._ahead.get(id(record))
        if known is not None:
            return [(record.prim, known)]
        prims = _bindable(record.prim) if record.has_subsets else [record.prim]
        by_purpose = (_bound_materials(prims, purpose) for purpose in self._purposes)
        return list(zip(prims, zip(*by_purpose, strict=True), strict=True))

    def _read(self, material: Any) -> MaterialDetails:
        path = material.GetPath().pathString
        known = self._details.get(path)
        if known is None:
            prim = material.GetPrim()
            # The copies of an instance share their materials.
            shared = prim.GetPrimInPrototype().GetPath().pathString if prim.IsInstanceProxy() else path
            if shared not in self._of_shared:
                self._of_shared[shared] = _read_details(material, path, self._time)
            known = self._details[path] = replace(self._of_shared[shared], prim_path=path)
        return known


def _shows_material(record: PrimRecord) -> bool:
    return record.is_gprim and not record.is_hidden and (record.is_bound or record.has_subsets)


def _instance_above(record: PrimRecord) -> str:
    """Return the path of the instance that a record is, or is in."""
    above = record
    while not above.is_instance and above.parent is not None:
        above = above.parent
    return above.path


def _authored_target(prim: Any) -> Any:
    """Return the path that the nearest binding at or above `prim` names; None if there is none."""
    while not prim.IsPseudoRoot():
        targets = read_targets(prim, "material:binding")
        if targets:
            return targets[0].GetPrimPath()
        prim = prim.GetParent()
    return None


def material_details(records: list[PrimRecord], time: Any = None) -> tuple[MaterialDetails, ...]:
    """Return the materials of one object as `MaterialReader` does; `time` None is the earliest."""
    return MaterialReader(Usd.TimeCode.EarliestTime() if time is None else time).read(records)


def _bindable(prim: Any) -> list[Any]:
    imageable = UsdGeom.Imageable(prim)
    subsets = [subset.GetPrim() for subset in UsdGeom.Subset.GetAllGeomSubsets(imageable)]
    # Subsets that partition the mesh leave nothing of its own material to be seen.
    family = UsdShade.Tokens.materialBind
    is_covered = subsets and UsdGeom.Subset.GetFamilyType(imageable, family) == UsdGeom.Tokens.partition
    return subsets if is_covered else [prim, *subsets]


def _bound_materials(prims: list[Any], purpose: str) -> list[Any]:
    """Return the material of each prim, an invalid one or None where it has none."""
    try:
        return list(UsdShade.MaterialBindingAPI.ComputeBoundMaterials(prims, purpose)[0]) if prims else []
    except UNREADABLE:
        # One at a time, so that only the prim at fault goes without.
        return [found for prim in prims for found in _bound_materials([prim], purpose)] if len(prims) > 1 else [None]


def _read_details(material: Any, path: str, time: Any) -> MaterialDetails:
    sources = [material.ComputeSurfaceSource(context)[0] for context in _RENDER_CONTEXTS]
    shaders = list({source.GetPath(): source for source in sources if source}.values())
    colors = [vector_of(_constant(shader, _BASE_COLOR, time)) for shader in shaders if not _is_mapped(shader)]
    roughness, metallic, opacity = (
        _first([_number(_constant(shader, names, time)) for shader in shaders])
        for names in (_ROUGHNESS, _METALLIC, _OPACITY)
    )
    return MaterialDetails(material.GetPrim().GetName(), path, _first(colors), roughness, metallic, opacity)


def _first(values: list[_T | None]) -> _T | None:
    return next((value for value in values if value is not None), None)


def _is_mapped(shader: Any) -> bool:
    """Return whether an MDL texture stands before the constant: OmniPBR takes the texture where there is one."""
    texture = shader.GetInput("diffuse_texture")
    value = value_of(texture, Usd.TimeCode.Default()) if texture else None
    return isinstance(value, Sdf.AssetPath) and bool(value.path)


def _constant(shader: Any, names: tuple[str, ...], time: Any) -> Any:
    """Return the value of the first authored input among `names`; None if it is computed, from a texture say."""
    for name in names:
        source = shader.GetInput(name)
        attributes = UsdShade.Utils.GetValueProducingAttributes(source) if source else []
        if len(attributes) == 1:
            return _value(attributes[0], time)
    return None


def _value(attribute: Any, time: Any) -> Any:
    if not UsdShade.Output.IsOutput(attribute):
        return value_of(attribute, time)
    shader = UsdShade.Shader(attribute.GetPrim())
    value = shader.GetInput("value") if shader else None
    # MaterialX writes constants as records: ND_constant_color3, ND_constant_float.
    if not value or value.HasConnectedSource() or not str(shader.GetShaderId()).startswith("ND_constant"):
        return None
    return value_of(value, time)


def vector_of(value: Any) -> Vector | None:
    """Return a colour to six figures, as 32-bit ones were typed; None for anything but three finite numbers."""
    if not isinstance(value, _VECTORS):
        return None
    # Vectors of Gf are many times faster to take apart as an array.
    x, y, z = (float(f"{part:.6g}") for part in np.array(value).tolist())
    return (x, y, z) if math.isfinite(x + y + z) else None


def _number(value: Any) -> float | None:
    # MaterialX has opacity as a colour; a grey one is a number.
    parts = [value] if isinstance(value, int | float) else list(vector_of(value) or ())
    is_one = len(set(parts)) == 1 and math.isfinite(parts[0])
    return float(f"{parts[0]:.6g}") if is_one else None
