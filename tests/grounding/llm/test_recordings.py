"""Export and import of recorded completions."""

import base64
import gzip
import hashlib
import json
from dataclasses import replace
from pathlib import Path

import pytest

from tests.grounding.llm.completions import COMPLETION, MODEL, OLD_COMPLETION, REQUEST, SCHEMA, UPGRADED, request_about
from usd2kg.errors import GroundingError, OutputError
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Completion
from usd2kg.grounding.llm.serialization import request_key


@pytest.fixture
def cache(tmp_path: Path):
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        yield cache


def test_stores_only_the_digests_of_images(cache, tmp_path: Path):
    image = b"\x89PNG\r\n\x1a\n" + bytes(range(256))
    request = replace(REQUEST, images=(image,))
    cache.put(MODEL, request, COMPLETION)
    assert cache.get(MODEL, request) == COMPLETION
    assert cache.get(MODEL, REQUEST) is None
    cache.export_recording(tmp_path / "recording.jsonl")
    recorded = (tmp_path / "recording.jsonl").read_bytes()
    assert json.loads(recorded)["request"]["images"] == [hashlib.sha256(image).hexdigest()]
    path = cache.path
    cache.close()
    for kept in (recorded, path.read_bytes()):
        assert image[8:40] not in kept
        assert base64.b64encode(image)[:40] not in kept
    with CompletionCache(tmp_path / "other.sqlite") as other:
        assert other.import_recording(tmp_path / "recording.jsonl") == 1
        assert other.get(MODEL, request) == COMPLETION
        other.export_recording(tmp_path / "again.jsonl")
    assert (tmp_path / "again.jsonl").read_bytes() == recorded


def test_imports_a_recording_of_format_1(cache, tmp_path: Path):
    with CompletionCache(tmp_path / "other.sqlite") as other:
        other.put(MODEL, REQUEST, COMPLETION)
        other.export_recording(tmp_path / "other.jsonl")
    line = json.loads((tmp_path / "other.jsonl").read_text("utf-8"))
    line["completion"] = json.loads(OLD_COMPLETION)
    (tmp_path / "old.jsonl").write_text(json.dumps(line), "utf-8")
    assert cache.import_recording(tmp_path / "old.jsonl") == 1
    assert cache.get(MODEL, REQUEST) == UPGRADED


def test_exports_sorted_json_lines_independent_of_insertion_order(tmp_path: Path):
    requests = [replace(REQUEST, user=user) for user in ("/World/café", "/World/cup", "/World/fork")]
    recordings = []
    for name, order in (("a", requests), ("b", requests[::-1])):
        with CompletionCache(tmp_path / f"{name}.sqlite") as cache:
            for request in order:
                cache.put(MODEL, request, COMPLETION)
            assert cache.export_recording(tmp_path / f"{name}.jsonl") == 3
        recordings.append((tmp_path / f"{name}.jsonl").read_text("utf-8"))
    assert recordings[0] == recordings[1]
    lines = [json.loads(line) for line in recordings[0].splitlines()]
    assert [line["key"] for line in lines] == sorted(request_key(MODEL, request) for request in requests)
    assert "café" in recordings[0]
    line = next(line for line in lines if line["request"]["user"] == "/World/cup")
    assert line == {
        "key": request_key(MODEL, requests[1]),
        "model": MODEL,
        "request": {
            "system": "Classes: Cup, Fork",
            "user": "/World/cup",
            "schema": SCHEMA,
            "most_tokens": 4096,
            "temperature": 0.0,
            "is_thinking": False,
            "sample": 0,
        },
        "completion": {
            "text": '{"class": "Cup"}',
            "finish": "stop",
            "usage": {
                "input_tokens": 12,
                "cached_tokens": 8,
                "output_tokens": 5,
                "estimated_tokens": 2,
                "written_tokens": 3,
            },
            "tokens": [['{"class": "', -0.125], ["Cup", -0.5], ['"}', 0.0]],
            "thinking": "A cup.",
        },
    }
    assert list(line["request"]["schema"]["properties"]) == ["reasoning", "class"]


def test_exports_an_empty_cache(cache, tmp_path: Path):
    assert cache.export_recording(tmp_path / "empty.jsonl") == 0
    assert (tmp_path / "empty.jsonl").read_bytes() == b""
    assert cache.import_recording(tmp_path / "empty.jsonl") == 0


def test_exports_some_completions_compressed(cache, tmp_path: Path):
    for number in range(3):
        cache.put(MODEL, request_about(number), Completion(f"answer {number}"))
    path = tmp_path / "some.jsonl.gz"
    wanted = {request_key(MODEL, request_about(1)), "sha256:0"}
    assert cache.export_recording(path, wanted) == 1
    first = path.read_bytes()
    assert [json.loads(line)["key"] for line in gzip.decompress(first).splitlines()] == [
        request_key(MODEL, request_about(1))
    ]
    cache.export_recording(path, wanted)
    assert path.read_bytes() == first
    with CompletionCache(tmp_path / "other.sqlite") as other:
        assert other.import_recording(path) == 1
        assert other.get(MODEL, request_about(1)) == Completion("answer 1")


@pytest.mark.parametrize(
    "damage", [lambda data: data[:-9], lambda data: b"no gzip", lambda data: data[:12] + b"\xff" * 40]
)
def test_rejects_a_damaged_compressed_recording(cache, tmp_path: Path, damage):
    cache.put(MODEL, REQUEST, COMPLETION)
    path = tmp_path / "some.jsonl.gz"
    cache.export_recording(path)
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(GroundingError, match="cannot be read as a recording of completions"):
        cache.import_recording(path)


def test_import_keeps_existing_completions(cache, tmp_path: Path):
    with CompletionCache(tmp_path / "other.sqlite") as other:
        other.put(MODEL, REQUEST, Completion("theirs"))
        other.put(MODEL, request_about(2), Completion("new"))
        other.export_recording(tmp_path / "other.jsonl")
    cache.put(MODEL, REQUEST, Completion("ours"))
    assert cache.import_recording(tmp_path / "other.jsonl") == 1
    assert cache.get(MODEL, REQUEST) == Completion("ours")
    assert cache.get(MODEL, request_about(2)) == Completion("new")


def _set(line: bytes, part: str | None, name: str, value: object) -> bytes:
    data = json.loads(line)
    (data[part] if part else data)[name] = value
    return json.dumps(data).encode()


BROKEN = {
    "cut off": (lambda line: line[:40], "Unterminated|Expecting|Invalid control"),
    "blank": (lambda line: b"", "Expecting value"),
    "not UTF-8": (lambda line: line.replace(b"Cup", b"\xff"), "utf-8"),
    "no object": (lambda line: b"[]", "the line should be an object with key, model, request, completion"),
    "nested too deep": (lambda line: b"[" * 100_000, "recursion"),
    "another key": (lambda line: _set(line, None, "key", "sha256:0"), "the key is not that of its model and request"),
    "another model": (lambda line: _set(line, None, "model", "m"), "the key is not that"),
    "another prompt": (lambda line: _set(line, "request", "user", "/World/knife"), "the key is not that"),
    "an unknown field": (lambda line: _set(line, "request", "seed", 1), "request should be an object with system"),
    "no images": (lambda line: _set(line, "request", "images", []), "expected SHA-256 digests"),
    "images themselves": (lambda line: _set(line, "request", "images", ["iVBORw0KGgo="]), "expected SHA-256 digests"),
    "other images": (lambda line: _set(line, "request", "images", ["0" * 64]), "the key is not that"),
    "no temperature": (lambda line: _set(line, "request", "temperature", float("nan")), "Out of range"),
    "text of numbers": (lambda line: _set(line, "completion", "text", 1), "text of completion is '1', expected str"),
    "a truth value": (
        lambda line: _set(line, "request", "sample", False),
        "sample of request is 'False', expected int",
    ),
    "unknown finish": (lambda line: _set(line, "completion", "finish", "tired"), "'tired' is not a valid Finish"),
    "tokens of one part": (
        lambda line: _set(line, "completion", "tokens", [["Cup"]]),
        "a token is \"\\['Cup'\\]\", expected its text and a number",
    ),
    "a half of format 1": (
        lambda line: _set(line, "completion", "mean_logprob", None),
        "completion should be an object with text",
    ),
    "no usage": (lambda line: _set(line, "completion", "usage", {}), "usage should be an object with input_tokens"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_reports_an_invalid_line_and_imports_nothing(tmp_path: Path, name: str):
    breaking, message = BROKEN[name]
    path = tmp_path / "recording.jsonl"
    with CompletionCache(tmp_path / "a.sqlite") as cache:
        for i in range(3):
            cache.put(MODEL, request_about(i), COMPLETION)
        cache.export_recording(path)
    lines = path.read_bytes().splitlines()
    path.write_bytes(b"\n".join([lines[0], breaking(lines[1]), lines[2]]))
    with CompletionCache(tmp_path / "b.sqlite") as cache:
        with pytest.raises(
            GroundingError, match=rf"recording\.jsonl: line 2 is not .*({message}).*nothing was imported"
        ):
            cache.import_recording(path)
        assert len(cache) == 0
        cache.put(MODEL, REQUEST, COMPLETION)
        assert len(cache) == 1


def test_reports_files_that_cannot_be_read_or_written(cache, tmp_path: Path):
    with pytest.raises(GroundingError, match=r"none\.jsonl: cannot be read as a recording .*No such file"):
        cache.import_recording(tmp_path / "none.jsonl")
    with pytest.raises(OutputError, match="does not exist"):
        cache.export_recording(tmp_path / "none" / "out.jsonl")
    with pytest.raises(OutputError, match="is the cache itself"):
        cache.export_recording(cache.path)
