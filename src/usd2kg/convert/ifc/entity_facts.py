"""Metadata of an IFC entity: name, kind, identifiers, properties."""

import re
from collections.abc import Mapping
from typing import Any

from usd2kg.knowledge import word_map, word_set
from usd2kg.words import split_identifier

__all__ = ["entity_data", "kind_word", "material_names", "name_of", "numbered_name"]

_CLASS_NAMES = word_map("ifc", "class_names")
_PREDEFINED_TYPES = word_map("ifc", "predefined_types")
_UNSPECIFIC = word_set("ifc", "unspecific_classes")


def name_of(entity: Any) -> str:
    """Return the name of an entity; of a space the long name, since its name often is a number. Never empty."""
    return _long_name(entity) or _short_name(entity) or _class_name(entity)


def numbered_name(entity: Any) -> str:
    """Return the name of an entity; of a space with a long name, its number before it: `102 Server Room`.

    IFC 4.3, IfcSpace: Name is the number or short name of a space, LongName its full name.
    """
    number, name = _short_name(entity), name_of(entity)
    is_new = number and re.search(rf"(?<!\w){re.escape(number)}(?!\w)", name) is None
    return f"{number} {name}" if _long_name(entity) and is_new else name


def _short_name(entity: Any) -> str:
    return (entity.Name or "").strip()


def _long_name(entity: Any) -> str:
    return (getattr(entity, "LongName", None) or "").strip() if entity.is_a("IfcSpace") else ""


def kind_word(entity: Any) -> str | None:
    """Return the words for the kind of an entity, from its predefined type or its class; None if both are generic."""
    import ifcopenshell.util.element  # noqa: PLC0415

    named = _PREDEFINED_TYPES.get(ifcopenshell.util.element.get_predefined_type(entity) or "")
    name = _class_name(entity)
    if named is not None or name in _UNSPECIFIC:
        return named
    return _CLASS_NAMES.get(name) or " ".join(split_identifier(name)).lower()


def _class_name(entity: Any) -> str:
    return str(entity.is_a()).removeprefix("Ifc")


def material_names(entity: Any) -> tuple[str, ...]:
    """Return the names of the materials of an element, of its layers and constituents, too."""
    import ifcopenshell.util.element  # noqa: PLC0415

    found = ifcopenshell.util.element.get_materials(entity)
    return tuple(dict.fromkeys(material.Name for material in found if material.Name))


def entity_data(entity: Any, metres: float, container: Any = None) -> dict[str, Any]:
    """Return identifiers, type, container, materials, classifications and property sets as JSON values.

    The elevation is in metres, `metres` being the length of the file's unit; properties are in the units of the file.
    """
    import ifcopenshell.util.classification  # noqa: PLC0415
    import ifcopenshell.util.element  # noqa: PLC0415

    element_type = ifcopenshell.util.element.get_type(entity)
    elevation = getattr(entity, "Elevation", None)
    references = ifcopenshell.util.classification.get_references(entity)
    values = {
        "globalId": entity.GlobalId,
        "class": entity.is_a(),
        "name": entity.Name,
        "description": entity.Description,
        "objectType": getattr(entity, "ObjectType", None),
        "predefinedType": ifcopenshell.util.element.get_predefined_type(entity),
        "tag": getattr(entity, "Tag", None),
        "type": element_type.Name if element_type is not None else None,
        "elevation": None if elevation is None else elevation * metres,
        "container": numbered_name(container) if container is not None else None,
        "containerId": container.GlobalId if container is not None else None,
        "materials": list(material_names(entity)),
        "classifications": sorted({reference.Name for reference in references if getattr(reference, "Name", None)}),
        "properties": _without_ids(ifcopenshell.util.element.get_psets(entity)),
    }
    return {key: value for key, value in values.items() if value not in (None, "", [], {})}


def _without_ids(sets: Mapping[str, Mapping[str, Any]]) -> dict[str, dict[str, Any]]:
    """Return property sets and quantities without the STEP ids that IfcOpenShell adds."""
    # The properties of doors and windows often have no name.
    return {
        name or "unnamed": {key: value for key, value in found.items() if key != "id"} for name, found in sets.items()
    }
