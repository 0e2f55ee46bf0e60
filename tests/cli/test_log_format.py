"""Messages and the log as JSON, and spans for OpenTelemetry."""

import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest

from tests.cli.conftest import Run

STEPS = ["read", "ground", "relate", "instantiate", "write"]


def usd2kg(*arguments: object, **environment: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-m", "usd2kg", *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
        env={**os.environ, **environment},
    )


def records(done: "subprocess.CompletedProcess[str]") -> list[dict[str, Any]]:
    return [json.loads(line) for line in done.stderr.splitlines()]


def test_each_line_is_a_record_with_the_time_of_the_steps(room: Path, tmp_path: Path):
    done = usd2kg("build", room, "-o", tmp_path / "g.ttl", "--log-format", "json")
    found = records(done)
    assert all(record.keys() >= {"time", "level", "message"} for record in found)
    steps = {record["step"]: record for record in found if "step" in record}
    assert [step for step in steps if step in STEPS] == STEPS
    assert all(0 <= record["seconds"] < 60 for record in steps.values())
    assert steps["read"]["objects"] == steps["ground"]["objects"] > 0
    assert steps["relate"]["relations"] > 0 and steps["instantiate"]["triples"] > 100
    assert any("written to" in record["message"] for record in found), "messages are records, too"


def test_errors_and_the_project_file_are_records(tmp_path: Path):
    (tmp_path / "usd2kg.toml").write_text('profile = "plain"\n')
    stage = tmp_path / "missing.usd"
    stage.write_text("no stage")
    found = records(usd2kg("--log-format=json", "build", stage))
    assert "sets profile" in found[0]["message"]
    assert (found[-1]["level"], str(stage) in found[-1]["message"]) == ("error", True)


def test_an_unknown_format_is_an_error(run: Run):
    done = run("doctor", "--log-format", "xml")
    assert (done.code, "--log-format xml: expected text or json" in done.err) == (2, True)


def test_verbose_shows_the_steps_as_text(room: Path, tmp_path: Path):
    lines = usd2kg("build", room, "-o", tmp_path / "g.ttl", "--verbose").stderr.splitlines()
    assert [line.partition(":")[0] for line in lines if line.partition(":")[0] in STEPS] == STEPS
    assert not any(
        line.startswith("ground:") for line in usd2kg("build", room, "-o", tmp_path / "g.ttl").stderr.splitlines()
    )


def test_spans_are_printed_on_request(room: Path, tmp_path: Path):
    pytest.importorskip("opentelemetry.sdk")
    done = usd2kg("build", room, "-o", tmp_path / "g.ttl", OTEL_TRACES_EXPORTER="console")
    assert done.returncode == 0
    for step in STEPS:
        assert f'"name": "usd2kg.{step}"' in done.stderr
    plain = usd2kg("build", room, "-o", tmp_path / "g.ttl", OTEL_TRACES_EXPORTER="none")
    assert '"name": "usd2kg.' not in plain.stderr


@contextmanager
def collector() -> Iterator[tuple[str, list[tuple[str, bytes, Mapping[str, str]]]]]:
    """A server that keeps what is sent to it."""
    received: list[tuple[str, bytes, Mapping[str, str]]] = []

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"]))
            received.append((self.path, body, dict(self.headers)))
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_: object) -> None:
            return

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_address[1]}", received
    finally:
        server.shutdown()
        server.server_close()


def test_spans_are_sent_to_a_collector(room: Path, tmp_path: Path):
    pytest.importorskip("opentelemetry.exporter.otlp.proto.http")
    from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import (  # noqa: PLC0415
        ExportTraceServiceRequest,
    )

    with collector() as (address, received):
        done = usd2kg(
            *("build", room, "-o", tmp_path / "g.ttl"),
            OTEL_EXPORTER_OTLP_ENDPOINT=address,
            OTEL_EXPORTER_OTLP_COMPRESSION="none",
        )
    assert done.returncode == 0
    assert {path for path, _, _ in received} == {"/v1/traces"}
    spans = [
        span
        for _, body, _ in received
        for resource in ExportTraceServiceRequest.FromString(body).resource_spans
        for scope in resource.scope_spans
        for span in scope.spans
    ]
    assert {f"usd2kg.{step}" for step in STEPS} <= {span.name for span in spans}
    ground = next(span for span in spans if span.name == "usd2kg.ground")
    assert {attribute.key for attribute in ground.attributes} == {"objects"}
    assert ground.end_time_unix_nano > ground.start_time_unix_nano


def test_a_wrong_exporter_is_said_and_stops_nothing(room: Path, tmp_path: Path):
    done = usd2kg("build", room, "-o", tmp_path / "g.ttl", OTEL_TRACES_EXPORTER="smoke")
    assert done.returncode == 0
    assert "OTEL_TRACES_EXPORTER=smoke: expected otlp, console or none" in done.stderr
