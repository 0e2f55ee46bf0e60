"""What trimesh does not pass on from a COLLADA file: the unit, and the geometries of named nodes."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from usd2kg.convert.sdf.xml_tree import parse_safely

__all__ = ["ColladaFacts", "read_collada"]


@dataclass
class ColladaFacts:
    """Facts of a COLLADA file (COLLADA 1.4.1)."""

    metres_per_unit: float = 1.0
    geometries: dict[str, set[str]] = field(default_factory=dict)
    """Name or id of a node → ids of the geometries in it and in the nodes below."""


def read_collada(path: Path) -> ColladaFacts:
    """Return facts of a file, which is safe to be parsed by other XML parsers, too.

    Raises:
        XmlError: it is no XML, declares entities, or is nested more than 100 deep.
        OSError: it cannot be read.
    """
    facts = ColladaFacts()
    above: list[tuple[str, ...]] = []

    def start(tag: str, attributes: Mapping[str, str], _: int) -> None:
        tag = tag.rpartition(":")[2]
        is_node = tag == "node"
        above.append(tuple(attributes[key] for key in ("name", "id") if key in attributes) if is_node else ())
        if tag == "unit":
            facts.metres_per_unit = _positive(attributes.get("meter", "")) or 1.0
        elif tag in {"instance_geometry", "instance_controller"}:
            for name in {name for names in above for name in names}:
                facts.geometries.setdefault(name, set()).add(attributes.get("url", "").removeprefix("#"))

    def end(_: str) -> None:
        above.pop()

    parse_safely(path, start, end)
    return facts


def _positive(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if 0 < value < 1e6 else None
