"""SDFormat and Gazebo worlds → prims: a component for each model, its links and visuals below it."""

from usd2kg.convert.sdf.read import read_prims

__all__ = ["read_prims"]
