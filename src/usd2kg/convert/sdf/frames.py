"""Resolve the frames of a model or world (SDFormat, "Pose frame semantics")."""

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from usd2kg.convert.sdf.model import Model, Pose, SdfLink, SdfWorld
from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.values import Matrix, inverse

__all__ = ["MODEL_FRAME", "NESTED", "WORLD_FRAME", "Scope"]

MODEL_FRAME = "__model__"
WORLD_FRAME = "world"
NESTED = "::"
"""Separates the names of a model and a frame in it."""


class _Entry(NamedTuple):
    matrix: Matrix
    relative_to: str
    attached_to: str | None
    """None for a link, to which other frames are attached."""


class Scope:
    """The named frames of a model or world."""

    def __init__(self, owner: Model | SdfWorld, notes: Notes, path: Path) -> None:
        """Collect the frames of `owner`, defined in the file `path`."""
        self.root = WORLD_FRAME if isinstance(owner, SdfWorld) else MODEL_FRAME
        self._scopes = {id(model): Scope(model, notes, model.path) for model in owner.models}
        self._children = {model.name: self._scopes[id(model)] for model in reversed(owner.models)}
        self._notes = notes
        self._path = path
        self._element = owner.element if isinstance(owner, Model) else None
        self._canonical_link = _canonical_link(owner)
        self._entries: dict[str, _Entry] = {}
        self._resolved: dict[str, Matrix] = {}
        self._add_all(owner)

    def scope_of(self, model: Model) -> "Scope":
        """Return the scope of a model of `owner`."""
        return self._scopes[id(model)]

    def _add_all(self, owner: Model | SdfWorld) -> None:
        for model in owner.models:
            self._add(model.name, _Entry(self._model_matrix(model), model.pose.relative_to or self.root, ""))
        for frame in owner.frames:
            relative_to = frame.pose.relative_to or frame.attached_to or self.root
            self._add(frame.name, _Entry(frame.pose.matrix, relative_to, frame.attached_to or self.root))
        for link in owner.links if isinstance(owner, Model) else ():
            self._add(link.name, _Entry(link.pose.matrix, link.pose.relative_to or self.root, None))
        for joint in owner.joints:
            self._add(joint.name, _Entry(joint.pose.matrix, joint.pose.relative_to or joint.child, joint.child))

    def _add(self, name: str, entry: _Entry) -> None:
        self._entries.setdefault(name, entry)

    def _model_matrix(self, model: Model) -> Matrix:
        """Return the pose of a model's own frame in the frame that its pose is relative to."""
        if not model.placement_frame:
            return model.pose.matrix
        placed = self.scope_of(model).pose(model.placement_frame)
        if placed is None:
            text = f"the placement frame {model.placement_frame!r} is not in the model {model.name}; it is left out"
            self._notes.add(model.path, model.element, text)
            return model.pose.matrix
        matrix: Matrix = model.pose.matrix @ inverse(placed)
        return matrix

    def pose(self, name: str) -> Matrix | None:
        """Return the pose of a frame in the frame of the model or world; None if there is no such frame.

        What leads to no frame of the scope, or in a circle, is taken as relative to the model or world, with a note.
        """
        if name == self.root:
            return np.eye(4)
        if self._entry(name) is None:
            return None
        chain: dict[str, Matrix] = {}
        start = np.eye(4)
        while name != self.root:
            if name in self._resolved:
                start = self._resolved[name]
                break
            entry = self._entry(name)
            if entry is None or name in chain:
                state = "is not in this scope" if entry is None else "is relative to itself"
                self._note(f"the frame {name!r} {state}; {self.root} is used")
                break
            chain[name] = entry.matrix
            name = entry.relative_to
        for link in reversed(chain):
            start = start @ chain[link]
            self._resolved[link] = start
        return start

    def place(self, pose: Pose, default: str) -> Matrix:
        """Return a pose in the frame of the model or world; `default` is its reference frame if it names none."""
        return self.pose_or_root(pose.relative_to or default) @ pose.matrix

    def place_model(self, model: Model) -> Matrix:
        """Return the pose of a model of `owner` in the frame of `owner`."""
        return self.pose_or_root(model.pose.relative_to or self.root) @ self._model_matrix(model)

    def pose_or_root(self, name: str) -> Matrix:
        """Return the pose of a frame; that of the model or world, with a note, if there is no such frame."""
        found = self.pose(name)
        if found is None:
            self._note(f"the frame {name!r} is not in this scope; {self.root} is used")
            return np.eye(4)
        return found

    def link_of(self, name: str) -> str | None:
        """Return the link that a frame is attached to, `MODEL::LINK` if it is in a nested model; None if none is."""
        seen: set[str] = set()
        while name not in seen:
            seen.add(name)
            if name == self.root:
                name = self._canonical_link
                continue
            first, separator, rest = name.partition(NESTED)
            if first in self._children:
                inner = self._children[first].link_of(rest if separator else MODEL_FRAME)
                return None if inner is None else f"{first}{NESTED}{inner}"
            entry = self._entries.get(name)
            if entry is None:
                return None
            if entry.attached_to is None:
                return name
            name = entry.attached_to
        return None

    def _entry(self, name: str) -> _Entry | None:
        if name in self._entries:
            return self._entries[name]
        first, separator, rest = name.partition(NESTED)
        if not separator or first not in self._children:
            return None
        inner = self._children[first].pose(rest)
        return None if inner is None else _Entry(inner, first, None)

    def _note(self, text: str) -> None:
        self._notes.add(self._path, self._element, text)


def _canonical_link(owner: Model | SdfWorld) -> str:
    if isinstance(owner, SdfWorld):
        return ""
    if owner.canonical_link:
        return owner.canonical_link
    named: Iterable[SdfLink | Model] = (*owner.links, *owner.models)
    return next((entry.name for entry in named), "")
