"""Authored metadata of prims: variant selections, free text and materials."""

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade

from usd2kg.convert import SOURCE_ID
from usd2kg.knowledge import word_set
from usd2kg.scene.model import MaterialDetails, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.settings import LIMITS, TEXTS
from usd2kg.scene.stage import UNREADABLE, read_targets, value_of
from usd2kg.words import split_identifier, words_of

__all__ = [
    "BASE_COLOR_INPUTS",
    "MaterialReader",
    "authored_texts",
    "clean_text",
    "source_id",
    "text_attributes",
    "text_names",
    "variant_selections",
    "vector_of",
]

_T = TypeVar("_T")

_TEXT_TYPES = frozenset({"string", "token", "string[]", "token[]"})
_TECHNICAL_NAMESPACES = word_set("scene", "technical_namespaces")
_TECHNICAL_KEYS = word_set("scene", "technical_keys")
_SWITCHES = word_set("scene", "switches")
_MIN_TEXT_LENGTH = 2
_MIN_WORD_LENGTH = 4
"""Letters that a fragment needs to count as a word in the detection of base64."""
_HEX = re.compile(r"(?:[a-z0-9]+:)?(?:0x)?(?=[a-f-]*[0-9])[0-9a-f-]{8,}|[0-9a-f]{16,}", re.IGNORECASE)
"""Hashes, UUIDs, colours and addresses, with or without a prefix such as `sha256:`."""
_BASE64 = re.compile(r"[A-Za-z0-9+/]{15,}={0,2}")
_PATH = re.compile(r"(?:[~.]{0,2}[/\\]|[A-Za-z]:[\\/]|@).*|\S*\\\S*|\S+/\S+/\S*|\S+\.[A-Za-z][A-Za-z0-9]{1,4}")
_URL = re.compile(r"(?:[a-z][a-z0-9+.-]*:/|www\.|mailto:|urn:|data:)\S*", re.IGNORECASE)

BASE_COLOR_INPUTS = ("diffuseColor", "base_color", "baseColor", "diffuse_color_constant", "diffuse_reflection_color")
_ROUGHNESS = ("roughness", "specular_roughness", "reflection_roughness_constant", "specular_reflection_roughness")
_METALLIC = ("metallic", "metalness", "base_metalness", "metallic_constant")
_OPACITY = ("opacity", "geometry_opacity", "alpha", "opacity_constant")
"""Shader inputs of UsdPreviewSurface; standard_surface, open_pbr_surface, gltf_pbr (MaterialX); OmniPBR, OmniSurface
(MDL)."""
_RENDER_CONTEXTS = ("", "mtlx", "mdl")
_VECTORS = (Gf.Vec3f, Gf.Vec3d, Gf.Vec3h)


def variant_selections(prim: Any) -> tuple[tuple[str, str], ...]:
    """Return (variant set, selected variant) of a prim, sorted by set; sets without a selection are left out."""
    if not prim.HasVariantSets():
        return ()
    sets = prim.GetVariantSets()
    pairs = ((str(name), str(sets.GetVariantSelection(name))) for name in sorted(sets.GetNames()))
    return tuple((name, selection) for name, selection in pairs if selection)


def source_id(prim: Any) -> str:
    """Return the identifier of a prim in the file that the stage was converted from; empty if none."""
    value = prim.GetCustomDataByKey(SOURCE_ID)
    return clean_text(value) if isinstance(value, str) else ""


def text_attributes(prim: Any, time: Any = None) -> tuple[tuple[str, str], ...]:
    """Return (name, text) of the free texts on a prim that belong to no schema: at most 20, each text once.

    String and token attributes by name (arrays are joined), then `customData:<key>`, then `assetInfo:<key>`. Texts have
    2 to 200 characters and at least one word; paths, URLs, numbers, switches, hashes and encoded data are left out.

    Args:
        prim: the prim, possibly an instance proxy.
        time: time code; None for the earliest.
    """
    texts: dict[str, str] = {}
    for name, text in _texts(prim, Usd.TimeCode.EarliestTime() if time is None else time):
        cleaned = clean_text(text)
        if _is_free_text(cleaned):
            texts.setdefault(cleaned, name)
    return tuple((name, text) for text, name in list(texts.items())[: LIMITS.max_texts])


def _texts(prim: Any, time: Any) -> Iterator[tuple[str, str]]:
    for name in text_names(prim, prim.GetAuthoredPropertyNames()):
        yield name, ", ".join(authored_texts(prim, name, time))
    if prim.HasAuthoredCustomData():
        # GetCustomData includes the documentation of the schema.
        data = {key: value for key, value in prim.GetCustomData().items() if prim.HasAuthoredCustomDataKey(key)}
        yield from _flatten("customData", data)
    if prim.HasAuthoredAssetInfo():
        yield from _flatten("assetInfo", prim.GetAssetInfo())


def text_names(prim: Any, names: Iterable[str]) -> list[str]:
    """Return the names of a prim's properties that may hold free text."""
    definition = prim.GetPrimDefinition()
    # No attribute of a schema is free text: purpose, visibility, orientation, and so on.
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


def authored_texts(prim: Any, attribute_name: str, time: Any) -> tuple[str, ...]:
    """Return the texts of a string or token attribute or array, as authored.

    Empty if there is no such attribute, no value, another type, or text that is not UTF-8. Without `time`, the default
    time is read.
    """
    attribute = prim.GetAttribute(attribute_name)
    if not attribute or str(attribute.GetTypeName()) not in _TEXT_TYPES:
        return ()
    try:
        return _as_texts(value_of(attribute, Usd.TimeCode.Default() if time is None else time))
    except UnicodeDecodeError:
        # An array decodes its texts when they are accessed.
        return ()


def _as_texts(value: Any) -> tuple[str, ...]:
    if isinstance(value, str):
        return (value,)
    is_list = value is not None and hasattr(value, "__len__") and not isinstance(value, bytes | Mapping)
    return tuple(item for item in value if isinstance(item, str)) if is_list else ()


def clean_text(text: str) -> str:
    """Return the text on one line, without unprintable characters such as control and bidirectional marks."""
    if text.isprintable():
        return " ".join(text.split())
    return " ".join("".join(c for c in text if c.isprintable() or c.isspace()).split())


def _is_free_text(text: str) -> bool:
    is_short_enough = _MIN_TEXT_LENGTH <= len(text) <= LIMITS.max_text_length
    if not is_short_enough or text[0] in "{[<" or text.lower() in _SWITCHES:
        return False
    if any(pattern.fullmatch(text) for pattern in (_HEX, _PATH, _URL)) or _is_base64(text):
        return False
    return bool(words_of(text))


def _is_base64(text: str) -> bool:
    if not _BASE64.fullmatch(text):
        return False
    # Identifiers consist of words, base64 of short fragments.
    parts = [part for part in split_identifier(text) if len(part) >= _MIN_WORD_LENGTH and part.isalpha()]
    return text.endswith("=") or sum(map(len, parts)) < TEXTS.min_word_share * len(text)


class MaterialReader:
    """Reads the materials of objects at one time; each material is read once, even if instances share it."""

    def __init__(self, time: Any, *, has_purpose_bindings: bool = True) -> None:
        self._time = time
        # Without bindings for a single purpose, all purposes have the same materials.
        self._purposes = ("full", "preview") if has_purpose_bindings else ("full",)
        self._details: dict[str, MaterialDetails] = {}
        self._of_shared: dict[str, MaterialDetails] = {}
        self._of_instances: dict[tuple[int, ...], tuple[str, tuple[MaterialDetails, ...]]] = {}
        self._ahead: dict[int, tuple[Any, ...]] = {}
        """id of a record → its material for each purpose, for prefetched records."""

    def prefetch(self, objects: Iterable[list[PrimRecord]]) -> None:
        """Compute the bindings of the objects that will be read next; OpenUSD computes many in parallel."""
        records = (record for records in objects if not _are_copies(records) for record in records)
        shown = [record for record in records if _shows_material(record) and not record.has_subsets]
        prims = [record.prim for record in shown]
        by_purpose = (_bound_materials(prims, purpose) for purpose in self._purposes)
        self._ahead = dict(zip(map(id, shown), zip(*by_purpose, strict=True), strict=True))

    def read(self, records: list[PrimRecord]) -> tuple[MaterialDetails, ...]:
        """Return the materials of the visible geometry among `records`, in order of appearance.

        Bindings are resolved by UsdShade (direct, inherited, collection-based, by strength) for the purposes `full` and
        `preview`, including geometry subsets. A binding to a missing material gives its name and path only.
        """
        root = records[0]
        if not _are_copies(records) or root.is_bound or root.source.is_bound:
            return self._resolve(records)
        # Bindings within a prototype are the same in all instances, and those below a reference in all equal ones.
        key = tuple(id(record.source) for record in records)
        instance = _copy_above(root)
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
        """Return (prim, material for each purpose) for a prim and its geometry subsets."""
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
            shared = prim.GetPrimInPrototype().GetPath().pathString if prim.IsInstanceProxy() else path
            if shared not in self._of_shared:
                self._of_shared[shared] = _read_details(material, path, self._time)
            known = self._details[path] = replace(self._of_shared[shared], prim_path=path)
        return known


def _shows_material(record: PrimRecord) -> bool:
    return record.is_gprim and not record.is_hidden and (record.is_bound or record.has_subsets)


def _are_copies(records: list[PrimRecord]) -> bool:
    """Return whether all prims of an object have equal ones elsewhere."""
    return records[0].source is not records[0]


def _copy_above(record: PrimRecord) -> str:
    """Return the path of the outermost reference that is equal to another, or of the instance, at or above a prim."""
    above = record
    while above.parent is not None and (above.parent.original if above.original else not above.is_instance):
        above = above.parent
    return above.path


def _authored_target(prim: Any) -> Any:
    """Return the target of the nearest binding at or above `prim`; None if there is none."""
    while not prim.IsPseudoRoot():
        targets = read_targets(prim, "material:binding")
        if targets:
            return targets[0].GetPrimPath()
        prim = prim.GetParent()
    return None


def _bindable(prim: Any) -> list[Any]:
    imageable = UsdGeom.Imageable(prim)
    subsets = [subset.GetPrim() for subset in UsdGeom.Subset.GetAllGeomSubsets(imageable)]
    # The material of a mesh is invisible if its subsets are a partition.
    family = UsdShade.Tokens.materialBind
    is_covered = subsets and UsdGeom.Subset.GetFamilyType(imageable, family) == UsdGeom.Tokens.partition
    return subsets if is_covered else [prim, *subsets]


def _bound_materials(prims: list[Any], purpose: str) -> list[Any]:
    """Return the material of each prim; invalid or None if it has none."""
    try:
        return list(UsdShade.MaterialBindingAPI.ComputeBoundMaterials(prims, purpose)[0]) if prims else []
    except UNREADABLE:
        # Retry one by one to lose only the corrupt prim.
        return [found for prim in prims for found in _bound_materials([prim], purpose)] if len(prims) > 1 else [None]


def _read_details(material: Any, path: str, time: Any) -> MaterialDetails:
    sources = [material.ComputeSurfaceSource(context)[0] for context in _RENDER_CONTEXTS]
    shaders = list({source.GetPath(): source for source in sources if source}.values())
    colors = [vector_of(_constant(shader, BASE_COLOR_INPUTS, time)) for shader in shaders if not _is_mapped(shader)]
    roughness, metallic, opacity = (
        _first([_number(_constant(shader, names, time)) for shader in shaders])
        for names in (_ROUGHNESS, _METALLIC, _OPACITY)
    )
    return MaterialDetails(material.GetPrim().GetName(), path, _first(colors), roughness, metallic, opacity)


def _first(values: list[_T | None]) -> _T | None:
    return next((value for value in values if value is not None), None)


def _is_mapped(shader: Any) -> bool:
    """Return whether an MDL texture overrides the constant colour, as in OmniPBR."""
    texture = shader.GetInput("diffuse_texture")
    value = value_of(texture, Usd.TimeCode.Default()) if texture else None
    return isinstance(value, Sdf.AssetPath) and bool(value.path)


def _constant(shader: Any, names: tuple[str, ...], time: Any) -> Any:
    """Return the value of the first authored input among `names`; None if it is computed, for example by a texture."""
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
    # MaterialX represents constants as nodes: ND_constant_color3, ND_constant_float.
    if not value or value.HasConnectedSource() or not str(shader.GetShaderId()).startswith("ND_constant"):
        return None
    return value_of(value, time)


def vector_of(value: Any) -> Vector | None:
    """Return a colour with six significant digits; None unless the value is a vector of three finite numbers."""
    if not isinstance(value, _VECTORS):
        return None
    # Converting a Gf vector by way of numpy is many times faster than indexing it.
    x, y, z = (float(f"{part:.6g}") for part in np.array(value).tolist())
    return (x, y, z) if math.isfinite(x + y + z) else None


def _number(value: Any) -> float | None:
    # Opacity is a colour in MaterialX; a grey one is read as a number.
    parts = [value] if isinstance(value, int | float) else list(vector_of(value) or ())
    is_one = len(set(parts)) == 1 and math.isfinite(parts[0])
    return float(f"{parts[0]:.6g}") if is_one else None
