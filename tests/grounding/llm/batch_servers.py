"""Fake HTTP servers with the batch endpoints of OpenAI, Anthropic and Gemini, and their files."""

import json
import re
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import UTC, datetime
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

OPENAI_USAGE = {
    "input_tokens": 100,
    "input_tokens_details": {"cached_tokens": 60},
    "output_tokens": 7,
    "output_tokens_details": {"reasoning_tokens": 0},
    "total_tokens": 107,
}
GEMINI_USAGE = {
    "promptTokenCount": 100,
    "cachedContentTokenCount": 60,
    "candidatesTokenCount": 7,
    "totalTokenCount": 107,
}
ANTHROPIC_USAGE = {
    "input_tokens": 40,
    "cache_read_input_tokens": 60,
    "cache_creation_input_tokens": 0,
    "output_tokens": 7,
}


@dataclass(frozen=True)
class Row:
    """How a service answers one request of a job."""

    text: str = ""
    error: str = ""
    """Message of an error with status 400; empty for an answer."""
    fate: str = ""
    """`expired`, `missing`, `stray` (under another id) or `malformed`; empty for a row of its own."""


@dataclass
class Job:
    """A job at the service."""

    id: str
    rows: dict[str, dict]
    """Row id → request."""
    created: float = field(default_factory=time.time)
    polls: int = 0


@dataclass(frozen=True)
class Reply:
    """A response; `body` is JSON, or bytes for files."""

    body: object = field(default_factory=dict)
    status: int = 200
    headers: dict[str, str] = field(default_factory=dict)
    is_lost: bool = False
    """Close the connection without an answer."""


class BatchServer:
    """A service with a batch endpoint; `answer` returns the row for the prompt of a request."""

    def __init__(self, answer: Callable[[str], Row], *, polls: int = 1) -> None:
        """Start the server; a job ends at its `polls`-th poll."""
        self.answer = answer
        self.polls = polls
        self.jobs: dict[str, Job] = {}
        self.asked: Counter[str] = Counter()
        """Prompt → number of jobs that have contained it."""
        self.requests: list[tuple[str, str]] = []
        """Method and path of all requests."""
        self.headers: list[dict[str, str]] = []
        self.intercept: Callable[[str, str], Reply | None] = lambda method, path: None
        """Called with method and path of each request; its reply comes before the server's."""
        self.after_create: Callable[[Job], Reply | None] = lambda job: None
        """Called when a job exists, before the response; its reply comes before the server's."""
        self._files: dict[str, bytes] = {}
        self._lock = threading.Lock()
        self._http = ThreadingHTTPServer(("127.0.0.1", 0), self._make_handler())
        self._thread = threading.Thread(target=self._http.serve_forever, kwargs={"poll_interval": 0.01})
        self._thread.start()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self._http.server_port}"

    def close(self) -> None:
        self._http.shutdown()
        self._http.server_close()
        self._thread.join()

    def _make_handler(self) -> type[BaseHTTPRequestHandler]:
        server = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"
            wbufsize = -1

            def _serve(self) -> None:
                body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
                headers = {name.lower(): value for name, value in self.headers.items()}
                with server._lock:
                    server.requests.append((self.command, self.path))
                    server.headers.append(headers)
                reply = server.intercept(self.command, self.path) or server._route(
                    self.command, self.path, headers, body
                )
                if reply.is_lost:
                    self.close_connection = True
                    return
                data = reply.body if isinstance(reply.body, bytes) else json.dumps(reply.body).encode()
                self.send_response(reply.status)
                self.send_header("Content-Type", "application/json")
                self.send_header("Content-Length", str(len(data)))
                for name, value in reply.headers.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(data)

            do_GET = do_POST = do_DELETE = _serve  # noqa: N815

            def log_message(self, format: str, *args: object) -> None:
                pass

        return Handler

    def _route(self, method: str, path: str, headers: dict[str, str], body: bytes) -> Reply:
        path, _, _ = path.partition("?")
        for pattern, handle in ROUTES[method]:
            if match := re.fullmatch(pattern, path):
                with self._lock:
                    return handle(self, *match.groups(), headers=headers, body=body)
        return refuse(404, f"no {method} {path}")

    def _add_job(self, rows: dict[str, dict], prompt: Callable[[dict], str], prefix: str) -> Job:
        job = Job(f"{prefix}{len(self.jobs) + 1}", rows)
        self.jobs[job.id] = job
        self.asked.update(prompt(request) for request in rows.values())
        return job

    def _has_ended(self, job: Job) -> bool:
        job.polls += 1
        return job.polls >= self.polls

    # OpenAI

    def _upload(self, *, headers: dict[str, str], body: bytes) -> Reply:
        boundary = headers["content-type"].partition("boundary=")[2].encode()
        part = next(part for part in body.split(b"--" + boundary) if b"filename=" in part)
        name = f"file-{len(self._files) + 1}"
        self._files[name] = part.partition(b"\r\n\r\n")[2].removesuffix(b"\r\n")
        return Reply(
            {"id": name, "object": "file", "bytes": 1, "created_at": 1, "filename": "batch.jsonl", "purpose": "batch"}
        )

    def _download(self, name: str, **_: object) -> Reply:
        return Reply(self._files[name])

    def _delete(self, name: str, **_: object) -> Reply:
        del self._files[name]
        return Reply({"id": name, "object": "file", "deleted": True})

    def _create_openai(self, *, body: bytes, **_: object) -> Reply:
        source = json.loads(body)["input_file_id"]
        lines = [json.loads(line) for line in self._files[source].splitlines()]
        job = self._add_job({line["custom_id"]: line["body"] for line in lines}, _openai_prompt, "batch_")
        self._files[f"{job.id}-input"] = self._files[source]
        return self.after_create(job) or Reply(self._openai_job(job, has_ended=False))

    def _openai_job(self, job: Job, *, has_ended: bool) -> dict:
        data = {
            "id": job.id,
            "object": "batch",
            "endpoint": "/v1/responses",
            "completion_window": "24h",
            "created_at": int(job.created),
            "input_file_id": f"{job.id}-input",
            "status": "in_progress",
            "request_counts": {"total": len(job.rows), "completed": 0, "failed": 0},
        }
        if not has_ended:
            return data
        rows = {row_id: self.answer(_openai_prompt(request)) for row_id, request in job.rows.items()}
        lines = [_openai_line(row_id, row) for row_id, row in rows.items() if row.fate not in ("expired", "missing")]
        self._files[f"{job.id}-output"] = b"\n".join(lines)
        is_expired = any(row.fate == "expired" for row in rows.values())
        return data | {"status": "expired" if is_expired else "completed", "output_file_id": f"{job.id}-output"}

    def _poll_openai(self, name: str, **_: object) -> Reply:
        if name not in self.jobs:
            return refuse(404, f"No batch found with id '{name}'.")
        return Reply(self._openai_job(self.jobs[name], has_ended=self._has_ended(self.jobs[name])))

    def _list_openai(self, **_: object) -> Reply:
        jobs = [self._openai_job(job, has_ended=False) for job in reversed(self.jobs.values())]
        return Reply({"object": "list", "data": jobs, "has_more": False})

    # Anthropic

    def _create_anthropic(self, *, body: bytes, **_: object) -> Reply:
        rows = {one["custom_id"]: one["params"] for one in json.loads(body)["requests"]}
        job = self._add_job(rows, _anthropic_prompt, "msgbatch_")
        return self.after_create(job) or Reply(self._anthropic_job(job, has_ended=False))

    def _anthropic_job(self, job: Job, *, has_ended: bool) -> dict:
        when = datetime.fromtimestamp(job.created, UTC).isoformat()
        counts = {"processing": len(job.rows), "succeeded": 0, "errored": 0, "canceled": 0, "expired": 0}
        return {
            "id": job.id,
            "type": "message_batch",
            "processing_status": "ended" if has_ended else "in_progress",
            "request_counts": counts,
            "created_at": when,
            "expires_at": when,
            "ended_at": when if has_ended else None,
            "archived_at": None,
            "cancel_initiated_at": None,
            "results_url": f"{self.url}/v1/messages/batches/{job.id}/results" if has_ended else None,
        }

    def _poll_anthropic(self, name: str, **_: object) -> Reply:
        if name not in self.jobs:
            return refuse(404, f"Message Batch {name} not found.")
        return Reply(self._anthropic_job(self.jobs[name], has_ended=self._has_ended(self.jobs[name])))

    def _results_anthropic(self, name: str, **_: object) -> Reply:
        rows = {row_id: self.answer(_anthropic_prompt(request)) for row_id, request in self.jobs[name].rows.items()}
        lines = [_anthropic_line(row_id, row) for row_id, row in rows.items() if row.fate != "missing"]
        return Reply(b"\n".join(lines))

    def _list_anthropic(self, **_: object) -> Reply:
        jobs = [self._anthropic_job(job, has_ended=False) for job in reversed(self.jobs.values())]
        return Reply({"data": jobs, "has_more": False, "first_id": None, "last_id": None})

    # Gemini

    def _start_upload(self, *, headers: dict[str, str], **_: object) -> Reply:
        return Reply({}, headers={"X-Goog-Upload-URL": f"{self.url}/upload-here", "X-Goog-Upload-Status": "active"})

    def _finish_upload(self, *, body: bytes, **_: object) -> Reply:
        name = f"file-{len(self._files) + 1}"
        self._files[name] = body
        return Reply({"file": {"name": f"files/{name}"}}, headers={"X-Goog-Upload-Status": "final"})

    def _create_gemini(self, *, body: bytes, **_: object) -> Reply:
        source = json.loads(body)["batch"]["inputConfig"]["fileName"].removeprefix("files/")
        lines = [json.loads(line) for line in self._files[source].splitlines()]
        job = self._add_job({line["key"]: line["request"] for line in lines}, _gemini_prompt, "batches/")
        return self.after_create(job) or Reply(self._gemini_job(job, has_ended=False))

    def _gemini_job(self, job: Job, *, has_ended: bool) -> dict:
        state = {"createTime": datetime.fromtimestamp(job.created, UTC).isoformat(), "state": "BATCH_STATE_RUNNING"}
        if has_ended:
            rows = {row_id: self.answer(_gemini_prompt(request)) for row_id, request in job.rows.items()}
            is_expired = all(row.fate == "expired" for row in rows.values())
            lines = [
                _gemini_line(row_id, row) for row_id, row in rows.items() if row.fate not in ("expired", "missing")
            ]
            name = job.id.replace("/", "-")
            self._files[name] = b"\n".join(lines)
            state["state"] = "BATCH_STATE_EXPIRED" if is_expired else "BATCH_STATE_SUCCEEDED"
            state |= {} if is_expired else {"output": {"responsesFile": f"files/{name}"}}
        return {"name": job.id, "metadata": {"name": job.id, **state}}

    def _poll_gemini(self, name: str, **_: object) -> Reply:
        job = self.jobs.get(f"batches/{name}")
        return (
            Reply(self._gemini_job(job, has_ended=self._has_ended(job)))
            if job is not None
            else refuse(404, f"batches/{name} not found.")
        )

    def _list_gemini(self, **_: object) -> Reply:
        return Reply({"operations": [self._gemini_job(job, has_ended=False) for job in self.jobs.values()]})


ROUTES: dict[str, list[tuple[str, Callable[..., Reply]]]] = {
    "POST": [
        ("/v1/files", BatchServer._upload),
        ("/v1/batches", BatchServer._create_openai),
        ("/v1/messages/batches", BatchServer._create_anthropic),
        ("/upload/v1beta/files", BatchServer._start_upload),
        ("/upload-here", BatchServer._finish_upload),
        ("/v1beta/models/[^/]+:batchGenerateContent", BatchServer._create_gemini),
    ],
    "GET": [
        ("/v1/files/([^/]+)/content", BatchServer._download),
        ("/v1/batches/([^/]+)", BatchServer._poll_openai),
        ("/v1/batches", BatchServer._list_openai),
        ("/v1/messages/batches/([^/]+)/results", BatchServer._results_anthropic),
        ("/v1/messages/batches/([^/]+)", BatchServer._poll_anthropic),
        ("/v1/messages/batches", BatchServer._list_anthropic),
        ("/v1beta/batches/([^/]+)", BatchServer._poll_gemini),
        ("/v1beta/batches", BatchServer._list_gemini),
        ("/(?:download/)?v1beta/files/([^/:]+):download", BatchServer._download),
    ],
    "DELETE": [("/v1/files/([^/]+)", BatchServer._delete), ("/v1beta/files/([^/]+)", BatchServer._delete)],
}


@contextmanager
def serve_batches(answer: Callable[[str], Row], *, polls: int = 1) -> Iterator[BatchServer]:
    server = BatchServer(answer, polls=polls)
    try:
        yield server
    finally:
        server.close()


def refuse(status: int, message: str) -> Reply:
    """Return an error response that the clients of all providers understand."""
    return Reply({"type": "error", "error": {"type": "some_error", "code": status, "message": message}}, status)


def _openai_prompt(request: dict) -> str:
    content = request["input"][-1]["content"]
    return content if isinstance(content, str) else "".join(part.get("text", "") for part in content)


def _anthropic_prompt(request: dict) -> str:
    content = request["messages"][-1]["content"]
    return content if isinstance(content, str) else "".join(part.get("text", "") for part in content)


def _gemini_prompt(request: dict) -> str:
    return "".join(part.get("text", "") for part in request["contents"][-1]["parts"])


def _named(row_id: str, row: Row) -> str:
    return "0" * 64 if row.fate == "stray" else row_id


def _openai_line(row_id: str, row: Row) -> bytes:
    tokens = [
        {"token": piece, "logprob": -0.1, "bytes": None, "top_logprobs": []} for piece in re.findall(".", row.text)
    ]
    part = {"type": "output_text", "text": row.text, "annotations": [], "logprobs": tokens}
    message = {"type": "message", "id": "m1", "role": "assistant", "status": "completed", "content": [part]}
    body = {
        "id": "r1",
        "object": "response",
        "created_at": 1,
        "model": "m",
        "status": "completed",
        "output": 7 if row.fate == "malformed" else [message],
        "usage": OPENAI_USAGE,
    }
    status = 200
    if row.error:
        status, body = 400, {"error": {"message": row.error, "type": "invalid_request_error", "code": None}}
    response = {"status_code": status, "request_id": "q1", "body": body}
    return json.dumps({"id": "b1", "custom_id": _named(row_id, row), "response": response, "error": None}).encode()


def _anthropic_line(row_id: str, row: Row) -> bytes:
    message = {
        "id": "msg_1",
        "type": "message",
        "role": "assistant",
        "model": "claude-haiku-4-5",
        "content": [{"type": "text", "text": row.text}],
        "stop_reason": "end_turn",
        "stop_sequence": None,
        "usage": None if row.fate == "malformed" else ANTHROPIC_USAGE,
    }
    result: dict = {"type": "succeeded", "message": message}
    if row.error:
        error = {"type": "error", "error": {"type": "invalid_request_error", "message": row.error}}
        result = {"type": "errored", "error": error}
    if row.fate == "expired":
        result = {"type": "expired"}
    return json.dumps({"custom_id": _named(row_id, row), "result": result}).encode()


def _gemini_line(row_id: str, row: Row) -> bytes:
    content = {"role": "model", "parts": "?" if row.fate == "malformed" else [{"text": row.text}]}
    response = {
        "candidates": [{"content": content, "finishReason": "STOP", "index": 0}],
        "usageMetadata": GEMINI_USAGE,
        "modelVersion": "gemini-2.5-flash",
    }
    data = {"error": {"code": 3, "message": row.error}} if row.error else {"response": response}
    return json.dumps({"key": _named(row_id, row), **data}).encode()
