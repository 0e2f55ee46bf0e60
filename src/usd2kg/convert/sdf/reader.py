"""SDFormat file → records, with the models that it includes."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from usd2kg.convert.converted import parse_error
from usd2kg.convert.sdf.budget import SdfBudget
from usd2kg.convert.sdf.elements import first_waypoint, read_axis, read_frame, read_link, read_pose, skin_of
from usd2kg.convert.sdf.merge import merge_models
from usd2kg.convert.sdf.model import Asset, Model, Pose, SdfFrame, SdfJoint, SdfLink, SdfWorld
from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.resources import ResourceError, Resources, asset_name
from usd2kg.convert.sdf.values import is_true
from usd2kg.convert.sdf.xml_files import XmlFiles
from usd2kg.convert.sdf.xml_tree import XmlElement, XmlError

__all__ = ["EXPECTED", "SdfReader"]

EXPECTED = "an SDFormat file, whose root element is <sdf> and has a world or a model"
_BYTES_PER_COUNT = 1024
_MAX_LEVELS = 32
"""Greatest depth of nested models."""
_VERSION = re.compile(r"1\.([0-9]{1,2})")
_LAST_VERSION = 12
"""SDFormat 1.12 is the version of Gazebo Jetty."""
_CONFIGS = ("model.config", "manifest.xml")
_TOP_ELEMENTS = ("model", "actor")
_LIGHTS = frozenset({"sun"})
"""Models of Gazebo's database that are lights; a world without its models must not get a thing of this name."""
_LEFT_OUT_OF_WORLDS = ("population", "road")
"""Things of a world that have no geometry of their own; `state` is not reported, since it repeats the models."""


class _Place(NamedTuple):
    """Where the reader is."""

    path: Path
    """The file."""
    files: tuple[Path, ...] = ()
    """It and the files that include it, from the outermost."""
    level: int = 0
    """Number of models around."""
    version: int = _LAST_VERSION
    """Second number of the version of SDFormat."""


class SdfReader:
    """Reads a file and what it includes."""

    def __init__(self, path: Path, resources: Resources, notes: Notes, budget: SdfBudget) -> None:
        self._path = path
        self._resources = resources
        self._notes = notes
        self._budget = budget
        self._files = XmlFiles()

    def read(self) -> SdfWorld:
        """Return the first world of the file, or its models.

        Raises:
            SceneError: it is no SDFormat file, includes itself, or has more elements than a scene can have.
        """
        try:
            root = self._files.read(self._path)
        except XmlError as error:
            raise parse_error(self._path, error, EXPECTED) from error
        if root.tag != "sdf":
            raise parse_error(self._path, f"line {root.line}: the root element is <{root.tag}>", EXPECTED)
        place = self._place(root, self._path.resolve(), ())
        worlds = list(root.find_all("world"))
        if worlds:
            if len(worlds) > 1:
                self._notes.add(self._path, worlds[1], f"only the first of {len(worlds)} worlds is read")
            return self._world(worlds[0], place)
        models = tuple(self._models(root, place))
        if not models:
            raise parse_error(self._path, f"line {root.line}: it has no world, model or actor", EXPECTED)
        return SdfWorld("", models)

    def _place(self, root: XmlElement, path: Path, above: tuple[Path, ...], level: int = 0) -> _Place:
        text = root.name("version")
        found = _VERSION.fullmatch(text)
        if found is None or int(found[1]) > _LAST_VERSION:
            self._notes.add(path, root, f"the version of SDFormat is {text!r}; it is read as 1.{_LAST_VERSION}")
        version = int(found[1]) if found else _LAST_VERSION
        return _Place(path, (*above, path), level, version)

    def _world(self, element: XmlElement, place: _Place) -> SdfWorld:
        for tag in _LEFT_OUT_OF_WORLDS:
            found = element.find(tag)
            if found is not None:
                self._notes.add(place.path, found, f"<{tag}> is left out")
        return SdfWorld(
            element.name(),
            tuple(self._models(element, place)),
            tuple(self._frames(element, place)),
            tuple(self._joints(element, place)),
        )

    def _models(self, parent: XmlElement, place: _Place) -> Iterator[Model]:
        """Yield models, actors and includes in the order of the file, without those that are merged."""
        for element in parent.children:
            if element.tag == "model":
                yield self._model(element, place)
            elif element.tag == "actor":
                yield self._actor(element, place)
            elif element.tag == "include" and not _is_merged(element):
                model = self._include(element, place)
                if model is not None:
                    yield model

    def _model(self, element: XmlElement, place: _Place) -> Model:
        self._count_model(element, place)
        inner = place._replace(level=place.level + 1)
        path, notes = place.path, self._notes
        model = Model(
            name=element.name(),
            pose=read_pose(element, path, notes),
            element=element,
            path=path,
            placement_frame=element.name("placement_frame"),
            canonical_link=element.name("canonical_link"),
            is_static=is_true(element.text_of("static")),
            links=tuple(self._links(element, place)),
            joints=tuple(self._joints(element, place)),
            frames=tuple(self._frames(element, place)),
            models=tuple(self._models(element, inner)),
        )
        for include in element.find_all("include"):
            if _is_merged(include):
                found = self._include(include, inner)
                model = model if found is None else merge_models(model, found, notes)
        return model

    def _actor(self, element: XmlElement, place: _Place) -> Model:
        """Return an actor as a model with a link that has its skin."""
        self._count_model(element, place)
        path, notes = place.path, self._notes
        pose = read_pose(element, path, notes)
        if element.find("pose") is None:
            pose = first_waypoint(element, path, notes) or pose
        links = list(self._links(element, place))
        skin = skin_of(element, path, notes)
        if skin is not None:
            links.append(skin)
        return Model(
            name=element.name(),
            pose=pose,
            element=element,
            path=path,
            is_static=True,
            is_person=skin is not None,
            links=tuple(links),
        )

    def _links(self, parent: XmlElement, place: _Place) -> Iterator[SdfLink]:
        for element in parent.find_all("link"):
            self._count_elements(element, place, 1 + sum(1 for _ in element.find_all("visual")))
            yield read_link(element, place.path, self._notes)

    def _frames(self, parent: XmlElement, place: _Place) -> Iterator[SdfFrame]:
        for element in parent.find_all("frame"):
            self._count_elements(element, place)
            yield read_frame(element, place.path, self._notes)

    def _joints(self, parent: XmlElement, place: _Place) -> Iterator[SdfJoint]:
        for element in parent.find_all("joint"):
            self._count_elements(element, place)
            yield SdfJoint(
                name=element.name(),
                type=element.name("type"),
                parent=element.text_of("parent"),
                child=element.text_of("child"),
                pose=read_pose(element, place.path, self._notes),
                element=element,
                path=place.path,
                axis=read_axis(element, place.version, place.path, self._notes),
            )

    def _count_model(self, element: XmlElement, place: _Place) -> None:
        self._count_elements(element, place)
        if place.level >= _MAX_LEVELS:
            raise self._budget.too_much(element, place.path, f"models that are nested more than {_MAX_LEVELS} deep")

    def _count_elements(self, element: XmlElement, place: _Place, count: int = 1) -> None:
        self._budget.count_elements(element, place.path, count)

    def _include(self, element: XmlElement, place: _Place) -> Model | None:
        """Return the model that an include names; one without links if it cannot be found; None for a light."""
        self._count_elements(element, place)
        uri = element.text_of("uri")
        if not uri:
            self._notes.add(place.path, element, "the include has no <uri>; it is left out")
            return None
        name = asset_name(uri)
        try:
            found, texts = self._included(uri, element, place)
        except (ResourceError, XmlError, OSError) as error:
            if name in _LIGHTS:
                return None
            self._notes.add(place.path, element, f"the model {uri} is not read ({error}); it has no geometry")
            self._count_model(element, place)
            found, texts = Model(name, Pose(np.eye(4)), element, place.path), {}
        if found is None:
            return None
        changes: dict[str, object] = {"asset": Asset(name or found.name, uri, texts)}
        own_name = element.text_of("name")
        if own_name or not found.name:
            changes["name"] = own_name or name
        if element.find("pose") is not None:
            changes["pose"] = read_pose(element, place.path, self._notes)
        else:
            # What the pose in the included file is relative to is not known here.
            changes["pose"] = Pose(found.pose.matrix)
        if element.find("placement_frame") is not None:
            changes["placement_frame"] = element.text_of("placement_frame")
        if element.find("static") is not None:
            changes["is_static"] = is_true(element.text_of("static"))
        return replace(found, **changes)  # type: ignore[arg-type]

    def _included(self, uri: str, element: XmlElement, place: _Place) -> tuple[Model | None, Mapping[str, str]]:
        """Return the first model of a file, and the texts about it.

        Raises:
            ResourceError: there is no such file, or it has no model.
            XmlError, OSError: it cannot be read.
            SceneError: it is among the files that include it.
        """
        path, texts = self._model_file(self._resources.find(uri, place.path.parent), element, place)
        if path in place.files:
            raise parse_error(
                self._path,
                f"{place.path.name}, line {element.line}: {uri} includes itself",
                "includes without a circle",
            )
        root = self._read_included(path, element, place)
        if root.tag != "sdf":
            raise ResourceError(f"the root element of {path.name} is <{root.tag}>, expected <sdf>")
        inner = self._place(root, path, place.files, place.level)
        first = next((child for child in root.children if child.tag in _TOP_ELEMENTS), None)
        if first is None:
            if root.find("light") is not None:
                return None, {}
            raise ResourceError(f"{path.name} has no model")
        return (self._model if first.tag == "model" else self._actor)(first, inner), texts

    def _read_included(self, path: Path, element: XmlElement, place: _Place) -> XmlElement:
        self._count_elements(element, place, path.stat().st_size // _BYTES_PER_COUNT)
        return self._files.read(path)

    def _model_file(self, found: Path, element: XmlElement, place: _Place) -> tuple[Path, Mapping[str, str]]:
        """Return the SDFormat file of a folder of a model, that of the highest version, and the texts of its config."""
        folder = found if found.is_dir() else found.parent
        root = self._config(folder, element, place)
        texts = {} if root is None else {tag: root.text_of(tag) for tag in ("name", "description")}
        texts = {tag: text for tag, text in texts.items() if text}
        if found.is_file():
            return found, texts
        files = {} if root is None else {_version_of(entry): entry.text for entry in root.find_all("sdf") if entry.text}
        name = files[max(files)] if files else "model.sdf"
        return self._resources.find(name, folder), texts

    def _config(self, folder: Path, element: XmlElement, place: _Place) -> XmlElement | None:
        """Return the config of a folder of a model; None without one, or with a note if it cannot be read."""
        name = next((name for name in _CONFIGS if (folder / name).is_file()), None)
        if name is None:
            return None
        try:
            return self._read_included(self._resources.find(name, folder), element, place)
        except (ResourceError, XmlError, OSError) as error:
            text = (
                f"the {name} of {element.text_of('uri')} is not read ({error}); its name and description are left out"
            )
            self._notes.add(place.path, element, text)
            return None


def _is_merged(include: XmlElement) -> bool:
    return is_true(include.name("merge"))


def _version_of(element: XmlElement) -> tuple[int, ...]:
    return tuple(int(part) for part in re.findall("[0-9]{1,4}", element.name("version")))
