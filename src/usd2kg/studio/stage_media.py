"""Pictures: thumbnails and geometry of the stage. All of OpenUSD is used from one thread."""

from collections import OrderedDict
from concurrent.futures import Future, ThreadPoolExecutor
from functools import cached_property
from pathlib import Path
from typing import Any

from usd2kg.errors import SceneError
from usd2kg.render import Renderer
from usd2kg.scene.object_geometry import GeometryReader
from usd2kg.scene.stage import open_stage, time_code
from usd2kg.studio.geometry_files import NO_MESHES, GeometryFiles
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.session import StudioSession
from usd2kg.studio.settings import SERVER
from usd2kg.studio.texture_images import TextureImage

__all__ = ["Pictures"]

_KEPT = 4096
"""Thumbnails in memory; about 20 kB each."""


class Pictures:
    """The stage of a session, read when the first picture is asked for."""

    def __init__(self, session: StudioSession, indices: PageIndices) -> None:
        self._session = session
        self._indices = indices
        self._thread = ThreadPoolExecutor(1, "usd2kg-pictures")
        self._thumbnails: OrderedDict[int, bytes] = OrderedDict()

    def thumbnail(self, index: int) -> "Future[bytes]":
        """Return the PNG of one object in its surroundings.

        The future raises SceneError if it has no visible geometry.
        """
        return self._thread.submit(self._thumbnail, index)

    def manifest(self) -> "Future[dict[str, Any]]":
        """Return the number of files with meshes, and of triangles."""
        return self._thread.submit(lambda: NO_MESHES if self._session.stage is None else self._geometry.manifest())

    def file(self, index: int) -> "Future[bytes]":
        """Return one GLB file; the future raises IndexError if there is none."""
        return self._thread.submit(lambda: self._geometry.file(index))

    def texture(self, index: int) -> "Future[TextureImage | None]":
        """Return the image of a texture; None if it is not shown. The future raises IndexError if there is none."""
        return self._thread.submit(lambda: self._geometry.texture(index))

    def close(self) -> None:
        """Stop; pictures that are waiting are dropped."""
        self._thread.shutdown(wait=True, cancel_futures=True)

    @cached_property
    def _renderer(self) -> Renderer:
        return Renderer(self._stage, self._session.project.sources.reading)

    @cached_property
    def _geometry(self) -> GeometryFiles:
        reading = self._session.project.sources.reading
        opened = open_stage(self._stage, reading)
        if opened.content_hash != self._session.scene.content_hash:
            raise SceneError(f"{self._stage}: has changed since it was read; start the studio again")
        reader = GeometryReader(opened, self._session.scene, time_code(reading.time))
        return GeometryFiles(reader, self._session.scene, self._indices)

    @property
    def _stage(self) -> Path:
        if self._session.stage is None:
            raise SceneError(self._session.stage_note)
        return self._session.stage

    def _thumbnail(self, index: int) -> bytes:
        if index in self._thumbnails:
            self._thumbnails.move_to_end(index)
            return self._thumbnails[index]
        path = self._session.scene.objects[index].prim_path
        picture = self._renderer.render_object(path, size=SERVER.thumbnail_size)
        self._thumbnails[index] = picture
        if len(self._thumbnails) > _KEPT:
            self._thumbnails.popitem(last=False)
        return picture
