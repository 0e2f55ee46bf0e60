"""Elements of SDFormat → records of poses, frames, links, visuals and axes."""

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from usd2kg.convert.sdf.frames import MODEL_FRAME
from usd2kg.convert.sdf.model import Axis, Pose, SdfFrame, SdfLink, Visual
from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.values import is_true, read_matrix, read_number, read_numbers
from usd2kg.convert.sdf.xml_tree import XmlElement

__all__ = ["first_waypoint", "read_axis", "read_frame", "read_link", "read_pose", "skin_of"]

_UNLIMITED = 1e9
"""SDFormat's default for the limits of a joint is 1e16."""
_LAST_VERSION_WITH_MODEL_AXES = 4
"""Up to SDFormat 1.4, the axis of a joint was in the frame of the model."""


def read_pose(element: XmlElement, path: Path, notes: Notes) -> Pose:
    """Return the pose of an element; identity without one."""
    found = element.find("pose")
    return Pose(read_matrix(found, path, notes), "" if found is None else found.name("relative_to"))


def read_frame(element: XmlElement, path: Path, notes: Notes) -> SdfFrame:
    """Return a frame."""
    return SdfFrame(element.name(), read_pose(element, path, notes), element.name("attached_to"))


def read_link(element: XmlElement, path: Path, notes: Notes) -> SdfLink:
    """Return a link with its visuals; collisions, sensors and lights are left out."""
    inertial = element.find("inertial")
    mass = None if inertial is None else read_number(inertial.find("mass"), path, notes)
    has_center = inertial is not None and inertial.find("pose") is not None
    return SdfLink(
        element.name(),
        read_pose(element, path, notes),
        tuple(_visuals(element, path, notes)),
        # A mass of 0 means that a simulator must not move the link, not that it is massless.
        mass if mass is not None and mass > 0 else None,
        read_pose(inertial, path, notes) if inertial is not None and has_center else None,
    )


def _visuals(link: XmlElement, path: Path, notes: Notes) -> Iterator[Visual]:
    for element in link.find_all("visual"):
        geometry = element.find("geometry")
        if geometry is None:
            notes.add(path, element, "the visual has no <geometry>; it is left out")
            continue
        yield Visual(
            element.name(),
            read_pose(element, path, notes),
            geometry,
            path,
            element.find("material"),
            read_number(element.find("transparency"), path, notes) or 0.0,
        )


def read_axis(joint: XmlElement, version: int, path: Path, notes: Notes) -> Axis | None:
    """Return the first axis of a joint; None without one. `version` is the minor version of SDFormat 1."""
    element = joint.find("axis")
    if element is None:
        return None
    found = element.find("xyz")
    xyz = read_numbers(found, 3, path, notes) or (0.0, 0.0, 1.0)
    if math.hypot(*xyz) < 1e-9:
        notes.add(path, found, "the axis is 0 0 0, expected a direction; it is taken as 0 0 1")
        xyz = (0.0, 0.0, 1.0)
    is_in_model = version <= _LAST_VERSION_WITH_MODEL_AXES or is_true(element.text_of("use_parent_model_frame"))
    expressed_in = MODEL_FRAME if is_in_model else "" if found is None else found.name("expressed_in")
    limit = element.find("limit")
    lower, upper = (None if limit is None else _limit(limit.find(tag), path, notes) for tag in ("lower", "upper"))
    return Axis(xyz, expressed_in, lower, upper)


def _limit(element: XmlElement | None, path: Path, notes: Notes) -> float | None:
    if element is None:
        return None
    try:
        value = float(element.text)
    except ValueError:
        notes.add(path, element, f"<{element.tag}> is {element.text[:60]!r}, expected a number; it is left out")
        return None
    return value if abs(value) < _UNLIMITED else None


def skin_of(actor: XmlElement, path: Path, notes: Notes) -> SdfLink | None:
    """Return a link with the skin of an actor; None without one."""
    skin = actor.find("skin")
    if skin is None or not skin.text_of("filename"):
        return None
    scale = read_number(skin.find("scale"), path, notes)
    mesh = XmlElement("mesh", line=skin.line)
    mesh.children.append(XmlElement("uri", text=skin.text_of("filename"), line=skin.line))
    mesh.children.append(XmlElement("scale", text=" ".join([str(1.0 if scale is None else scale)] * 3)))
    geometry = XmlElement("geometry", children=[mesh], line=skin.line)
    return SdfLink("body", Pose(np.eye(4)), (Visual("skin", Pose(np.eye(4)), geometry, path),))


def first_waypoint(actor: XmlElement, path: Path, notes: Notes) -> Pose | None:
    """Return the first waypoint of an actor; None if its script has none."""
    script = actor.find("script")
    trajectory = None if script is None else script.find("trajectory")
    waypoint = None if trajectory is None else trajectory.find("waypoint")
    return None if waypoint is None else read_pose(waypoint, path, notes)
