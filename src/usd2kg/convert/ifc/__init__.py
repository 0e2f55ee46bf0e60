"""IFC → prims: storeys, rooms and elements of a building, by IfcOpenShell."""

from usd2kg.convert.ifc.building import read_prims

__all__ = ["read_prims"]
