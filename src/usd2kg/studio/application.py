"""make_app: the ASGI application of the studio. Each route has a record in `web/src/api/types.ts`."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import asynccontextmanager
from dataclasses import asdict
from functools import partial
from typing import Any, ParamSpec, TypeVar

from starlette.applications import Starlette
from starlette.background import BackgroundTask
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Route

from usd2kg.endpoint.app_files import AppFile
from usd2kg.endpoint.guard import Guard
from usd2kg.errors import Usd2kgError
from usd2kg.studio.access import KeyGate
from usd2kg.studio.audit import audit_json
from usd2kg.studio.comparison import Comparison
from usd2kg.studio.decision_request import read_decision
from usd2kg.studio.disagreement import DISAGREEMENT_ORDER, make_disagreement_queue
from usd2kg.studio.exports import EXPORTS
from usd2kg.studio.live_events import LiveEvents
from usd2kg.studio.object_page import object_page, relation_json
from usd2kg.studio.object_review import ObjectReview
from usd2kg.studio.other_version import OtherVersion
from usd2kg.studio.outputs import OutputFiles
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.questions import Questions
from usd2kg.studio.request_body import BadRequestError, field, object_indices, read_body
from usd2kg.studio.review_queue import AUDIT_ORDER, QUEUE_ORDERS, estimate_seconds, make_audit_queue, make_queue
from usd2kg.studio.reviewer_agreement import find_agreement
from usd2kg.studio.scene_json import scene_json, state_json
from usd2kg.studio.session import StudioSession
from usd2kg.studio.stage_media import Pictures

__all__ = ["make_app"]

_T = TypeVar("_T")
_P = ParamSpec("_P")
Handler = Callable[[Request], Awaitable[Response]]
_REVIEW_THREADS = 2


def make_app(
    session: StudioSession,
    files: dict[str, AppFile],
    *,
    key: str,
    reviewer: str,
    hosts: Iterable[str] = (),
    other: OtherVersion | None = None,
    when_ready: Callable[[], None] = lambda: None,
) -> Starlette:
    """Return the application.

    Args:
        session: the scene under review.
        files: the page, by URL path.
        key: the access key that requests for data must carry.
        reviewer: the name that the page suggests for the reviewer.
        hosts: host names that are served in addition to localhost and IP addresses.
        other: the version that the scene is compared with; None for no comparison.
        when_ready: called when requests are answered.
    """
    api = _Api(session, reviewer, other)

    @asynccontextmanager
    async def lifespan(_: Starlette) -> AsyncIterator[None]:
        when_ready()
        yield
        await asyncio.to_thread(api.close)

    def serve_file(path: str, file: AppFile) -> Handler:
        async def serve(_: Request) -> Response:
            return Response(file.content, media_type=file.media_type, headers=file.headers(path))

        return serve

    app = Starlette(
        routes=[
            *(Route(path, serve_file(path, file)) for path, file in files.items()),
            *(Route(f"/api{path}", _checked(handler), methods=[method]) for method, path, handler in api.routes()),
        ],
        middleware=[Middleware(Guard, hosts=tuple(hosts), origins=()), Middleware(KeyGate, key=key)],
        lifespan=lifespan,
    )
    app.state.end_streams = api.end_streams
    return app


def _checked(handler: Handler) -> Handler:
    """Return a handler whose errors are JSON."""

    async def checked(request: Request) -> Response:
        try:
            return await handler(request)
        except BadRequestError as error:
            return JSONResponse({"error": str(error)}, error.status)
        except Usd2kgError as error:
            return JSONResponse({"error": str(error)}, 422)

    return checked


class _Api:
    """The handlers of requests for data."""

    def __init__(self, session: StudioSession, reviewer: str, other: OtherVersion | None) -> None:
        self._session = session
        self._indices = PageIndices(session.scene, session.tbox, session.suggestions, session.relations)
        self._reviewer = reviewer
        self._events = LiveEvents()
        self._pictures = Pictures(session, self._indices)
        self._questions = Questions(session, self._indices)
        self._outputs = OutputFiles(session, lambda: self._events.publish_soon("outputs", self._outputs_json()))
        self._comparison = None if other is None else Comparison(session, self._indices, other)
        # Questions and graphs may take seconds, on the threads of `asyncio.to_thread`; no decision waits for them.
        self._review_threads = ThreadPoolExecutor(_REVIEW_THREADS, "usd2kg-review")

    async def _soon(self, function: Callable[_P, _T], *args: _P.args, **kwargs: _P.kwargs) -> _T:
        """Return the result of a function that takes milliseconds."""
        loop = asyncio.get_running_loop()
        return await loop.run_in_executor(self._review_threads, partial(function, *args, **kwargs))

    def routes(self) -> list[tuple[str, str, Handler]]:
        """Return (method, path, handler)."""
        return [
            ("GET", "/scene", self._scene),
            ("GET", "/states", self._states),
            ("GET", "/object/{index:int}", self._object),
            ("GET", "/relations", self._relations),
            ("GET", "/comparison", self._compare),
            ("GET", "/queue", self._queue),
            ("GET", "/events", self._stream),
            ("GET", "/geometry", self._geometry),
            ("GET", "/geometry/{index:int}.glb", self._geometry_file),
            ("GET", "/geometry/textures/{index:int}", self._texture),
            ("GET", "/thumbnail/{index:int}.png", self._thumbnail),
            ("GET", "/examples", self._examples),
            ("GET", "/export/{name}", self._export),
            ("POST", "/decisions", self._decide),
            ("POST", "/undo", self._undo),
            ("POST", "/redo", self._redo),
            ("POST", "/reground", self._ground_again),
            ("POST", "/ask", self._ask),
            ("POST", "/sparql", self._sparql),
        ]

    def end_streams(self) -> None:
        """End the streams of changes."""
        self._events.close()

    def close(self) -> None:
        """Write the files, and stop all threads."""
        self._review_threads.shutdown()
        self._outputs.close()
        self._questions.close()
        self._pictures.close()

    # The scene.

    async def _scene(self, _: Request) -> Response:
        has_comparison = self._comparison is not None
        return JSONResponse(
            {**scene_json(self._session, self._indices, self._reviewer), "has_comparison": has_comparison},
            # The page draws the boxes, then asks for meshes; the stage is opened meanwhile.
            background=BackgroundTask(self._pictures.manifest),
        )

    async def _states(self, request: Request) -> Response:
        reviewer = request.query_params.get("reviewer", self._reviewer)
        return JSONResponse(self._reply(self._session.states(), reviewer))

    def _reply(self, states: list[ObjectReview], reviewer: str) -> dict[str, Any]:
        return {
            "version": self._session.version,
            "states": [state_json(state, self._indices) for state in states],
            "can_undo": self._session.review.can_undo(reviewer),
            "can_redo": self._session.review.can_redo(reviewer),
            "outputs": self._outputs_json(),
        }

    def _outputs_json(self) -> dict[str, str]:
        return {"folder": str(self._outputs.folder), "problem": self._outputs.problem}

    async def _object(self, request: Request) -> Response:
        index = self._index(request)
        return JSONResponse(await self._soon(object_page, self._session, self._indices, index))

    def _index(self, request: Request) -> int:
        index = int(request.path_params["index"])
        if index >= len(self._session.scene.objects):
            raise BadRequestError(f"there is no object {index}", 404)
        return index

    async def _relations(self, request: Request) -> Response:
        kind = request.query_params.get("kind", "")
        # The graph of the current decisions, which change what may hold and bear something.
        await asyncio.to_thread(self._session.graph)
        found = [relation_json(r, self._indices) for r in self._session.relations if r.kind == kind]
        return JSONResponse({"relations": found})

    async def _compare(self, _: Request) -> Response:
        if self._comparison is None:
            raise BadRequestError("there is nothing to compare; start with --compare OTHER", 404)
        return JSONResponse(await asyncio.to_thread(self._comparison.json))

    # Review.

    async def _queue(self, request: Request) -> Response:
        order = request.query_params.get("order", QUEUE_ORDERS[0])
        second = self._session.second
        expected = (*QUEUE_ORDERS, AUDIT_ORDER, *([DISAGREEMENT_ORDER] if second is not None else []))
        if order not in expected:
            raise BadRequestError(f"order {order[:40]!r} is unknown; expected one of {', '.join(expected)}")
        states, audit, by_path = self._session.states(), self._session.audit(), self._session.scene.by_path
        if order == AUDIT_ORDER:
            groups = make_audit_queue(audit.waiting, self._session.predictions, by_path)
        elif order == DISAGREEMENT_ORDER and second is not None:
            groups = make_disagreement_queue(states, by_path, second)
        else:
            groups = make_queue(states, by_path, self._indices.room_of, order)
        still_open = sum(state.status.is_open for state in states)
        return JSONResponse(
            {
                "groups": [
                    {
                        "id": group.id,
                        "title": group.title,
                        "objects": [self._indices.object(path) for path in group.objects],
                        "suggested": self._indices.class_(group.suggested),
                        "concept": self._indices.concept(group.concept),
                        "confidence": group.confidence,
                        "gain": group.gain,
                        "is_disputed": group.is_disputed,
                        "second": self._indices.class_(group.second),
                    }
                    for group in groups
                ],
                "open": still_open,
                "decided": len(states) - still_open,
                "agreement": [asdict(found) for found in find_agreement(self._session.review.by_reviewer())],
                "audit": audit_json(audit),
                "seconds_left": estimate_seconds(self._session.journal.events, len(groups)),
            }
        )

    async def _decide(self, request: Request) -> Response:
        body = await read_body(request)
        objects = self._session.scene.objects
        paths = [objects[index].prim_path for index in object_indices(body, len(objects))]
        reviewer = _reviewer(body)
        seen = field(body, "seen", int, self._session.version)
        decision = read_decision(body, paths, self._session, self._indices)
        changed = await self._soon(
            self._session.decide,
            decision.verdicts,
            reviewer,
            seen,
            concept=decision.concept,
            is_audit=decision.is_audit,
        )
        return self._announce(changed, body, f"{decision.action} {len(changed)} objects")

    async def _undo(self, request: Request) -> Response:
        body = await read_body(request)
        return self._announce(await self._soon(self._session.undo, _reviewer(body)), body, "undo")

    async def _redo(self, request: Request) -> Response:
        body = await read_body(request)
        return self._announce(await self._soon(self._session.redo, _reviewer(body)), body, "redo")

    async def _ground_again(self, request: Request) -> Response:
        body = await read_body(request)
        changes = await asyncio.to_thread(self._session.ground_again)
        # Suggestions are not events of the journal: the other pages load all states.
        self._events.publish("suggestions", {"reviewer": _reviewer(body), "page": field(body, "page", str, "")})
        self._outputs.notify()
        found = [
            {
                "object": self._indices.object(new.prim_path),
                "before": self._indices.class_(old.class_iri),
                "after": self._indices.class_(new.class_iri),
                "reason": new.explanation,
            }
            for old, new in changes
        ]
        all_states = [state_json(state, self._indices) for state in self._session.states()]
        return JSONResponse({"version": self._session.version, "states": all_states, "changes": found})

    def _announce(self, changed: list[ObjectReview], body: dict[str, Any], message: str) -> Response:
        """Tell all pages of a change, and return the answer to the page that made it."""
        reviewer = _reviewer(body)
        reply = {**self._reply(changed, reviewer), "message": message}
        change = {key: reply[key] for key in ("version", "states", "message", "can_undo", "can_redo")}
        self._events.publish("change", {**change, "reviewer": reviewer, "page": field(body, "page", str, "")})
        self._outputs.notify()
        return JSONResponse(reply)

    async def _stream(self, request: Request) -> Response:
        """Stream the changes; a page that has missed some gets the states of all objects first."""
        since = request.query_params.get("since", "")
        # First listen, then compare, so that no change is missed in between.
        listener = self._events.subscribe()
        first = ""
        if since.isdecimal() and int(since) < self._session.version:
            first = LiveEvents.format(
                "change",
                {
                    "version": self._session.version,
                    "reviewer": "",
                    "page": "",
                    "message": "",
                    "can_undo": False,
                    "can_redo": False,
                    "states": [state_json(state, self._indices) for state in self._session.states()],
                },
            )
        return StreamingResponse(self._events.listen(listener, first), media_type="text/event-stream")

    # Pictures.

    async def _geometry(self, _: Request) -> Response:
        manifest = await _wait(self._pictures.manifest())
        if not manifest["chunks"]:
            self._outputs.notify()
        return JSONResponse(manifest)

    async def _geometry_file(self, request: Request) -> Response:
        index = int(request.path_params["index"])
        try:
            content = await _wait(self._pictures.file(index))
        except IndexError as error:
            raise BadRequestError("there is no such file", 404) from error
        if index + 1 == len((await _wait(self._pictures.manifest()))["chunks"]):
            # The first graph is built when the page has what it shows.
            self._outputs.notify()
        return Response(content, media_type="model/gltf-binary")

    async def _texture(self, request: Request) -> Response:
        try:
            image = await _wait(self._pictures.texture(int(request.path_params["index"])))
        except IndexError as error:
            raise BadRequestError("there is no such texture", 404) from error
        return Response(status_code=204) if image is None else Response(image.content, media_type=image.media_type)

    async def _thumbnail(self, request: Request) -> Response:
        return Response(await _wait(self._pictures.thumbnail(self._index(request))), media_type="image/png")

    # Questions and files.

    async def _ask(self, request: Request) -> Response:
        question = field(await read_body(request), "question", str)
        return JSONResponse(await asyncio.to_thread(self._questions.ask, question))

    async def _sparql(self, request: Request) -> Response:
        query = field(await read_body(request), "query", str)
        return JSONResponse(await asyncio.to_thread(self._questions.sparql, query))

    async def _examples(self, _: Request) -> Response:
        return JSONResponse(await asyncio.to_thread(self._questions.examples))

    async def _export(self, request: Request) -> Response:
        name = request.path_params["name"]
        export = EXPORTS.get(name)
        if export is None:
            raise BadRequestError(f"there is no export {name[:40]!r}; expected one of {', '.join(EXPORTS)}", 404)
        content = await asyncio.to_thread(export.write, self._session)
        return Response(
            content,
            media_type=f"{export.media_type}; charset=utf-8",
            headers={"Content-Disposition": f'attachment; filename="{name}"'},
        )


def _reviewer(body: dict[str, Any]) -> str:
    reviewer = field(body, "reviewer", str).strip()
    if not reviewer or not reviewer.isprintable():
        raise BadRequestError("field reviewer: expected a name or an IRI such as an ORCID iD")
    return reviewer


async def _wait(future: "Future[_T]") -> _T:
    return await asyncio.wrap_future(future)
