"""Completions are paid for once: what is put can be got, whatever happens to the process."""

import base64
import hashlib
import json
import multiprocessing
import os
import signal
import sqlite3
import stat
import subprocess
import sys
import threading
from dataclasses import fields, replace
from pathlib import Path
from types import MappingProxyType

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.errors import GroundingError, OutputError
from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.serialization import request_key

MODEL = "google:gemini-2.5-flash"
SCHEMA = {"type": "object", "properties": {"reasoning": {"type": "string"}, "class": {"enum": ["Cup", "Fork"]}}}
REQUEST = Request("Classes: Cup, Fork", "/World/cup_01", SCHEMA)
TOKENS = (('{"class": "', -0.125), ("Cup", -0.5), ('"}', 0.0))
COMPLETION = Completion('{"class": "Cup"}', Finish.STOP, Usage(12, 8, 5, 2, 3), TOKENS, "A cup.")
SPAWN = multiprocessing.get_context("spawn")


@pytest.fixture
def cache(tmp_path: Path):
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        yield cache


# Half a surrogate pair is half a file name that someone cut; it must not stop a run.
TEXTS = st.text(st.characters(), max_size=40) | st.sampled_from(
    ["\x00", "a\x00b", "\ud83d", "🍴", "\u2028", '\\ud83d"', ""]
)
COUNTS = st.integers(0, 2**70)
TOKENS_OF_A_TEXT = st.lists(st.tuples(TEXTS, st.floats(max_value=0, allow_nan=False)), max_size=4).map(tuple)


@settings(max_examples=150, deadline=None)
@given(
    asked=st.builds(
        Request,
        TEXTS,
        TEXTS,
        st.dictionaries(TEXTS, TEXTS | st.lists(TEXTS), max_size=3),
        COUNTS,
        st.floats(0, 2),
        st.booleans(),
        COUNTS,
        st.lists(st.binary(max_size=9), max_size=2).map(tuple),
    ),
    said=st.builds(
        Completion,
        TEXTS,
        st.sampled_from(Finish),
        st.builds(Usage, COUNTS, COUNTS, COUNTS, COUNTS, COUNTS),
        TOKENS_OF_A_TEXT,
        TEXTS,
    ),
    model=TEXTS,
)
def test_every_field_comes_back_and_survives_a_recording(tmp_path_factory, model, asked, said):
    folder = tmp_path_factory.mktemp("cache")
    with CompletionCache(folder / "a.sqlite") as first, CompletionCache(folder / "b.sqlite") as second:
        first.put(model, asked, said)
        assert first.get(model, asked) == said
        assert first.export_recording(folder / "a.jsonl") == 1
        assert second.import_recording(folder / "a.jsonl") == 1
        assert second.get(model, asked) == said
        second.export_recording(folder / "b.jsonl")
    assert (folder / "a.jsonl").read_bytes() == (folder / "b.jsonl").read_bytes()


def test_two_halves_of_a_pair_come_back_as_their_character(cache):
    cache.put(MODEL, replace(REQUEST, user="\ud83d\ude00"), Completion("\ud83d\ude00"))
    assert cache.get(MODEL, replace(REQUEST, user="😀")) == Completion("😀")


def test_a_whole_number_as_logprob_can_be_read_back(cache):
    cache.put(MODEL, REQUEST, Completion("x", tokens=(("x", 0),)))
    assert cache.get(MODEL, REQUEST) == Completion("x", tokens=(("x", 0.0),))


def test_what_was_never_asked_is_none(cache):
    cache.put(MODEL, REQUEST, COMPLETION)
    assert cache.get(MODEL, replace(REQUEST, sample=1)) is None
    assert cache.get("google:gemini-3-flash", REQUEST) is None


@pytest.mark.parametrize("finish", [Finish.LENGTH, Finish.DEGENERATE])
def test_what_was_cut_off_is_kept_too(cache, finish):
    said = Completion("Cup Cup Cup Cup", finish, Usage(12, 0, 4096))
    cache.put(MODEL, REQUEST, said)
    assert cache.get(MODEL, REQUEST) == said


def test_the_first_completion_stays_unless_it_is_replaced(cache):
    cache.put(MODEL, REQUEST, COMPLETION)
    cache.put(MODEL, REQUEST, Completion("second"))
    assert cache.get(MODEL, REQUEST) == COMPLETION
    cache.put(MODEL, REQUEST, Completion("third"), replace=True)
    assert cache.get(MODEL, REQUEST) == Completion("third")
    assert len(cache) == 1


def test_instructions_and_schema_are_held_once(cache):
    system = "".join(f"class number {i}\n" for i in range(6000))
    for i in range(100):
        cache.put(MODEL, replace(REQUEST, system=system, user=f"/World/cup_{i}"), COMPLETION)
    path = cache.path
    cache.close()
    assert len(system) > 100_000
    assert path.stat().st_size < 2 * len(system)


CHANGES = {
    "system": "Classes: Fork, Cup",
    "user": "/World/cup_02",
    "schema": {"type": "object"},
    "max_tokens": 4097,
    "temperature": 0.7,
    "is_thinking": True,
    "sample": 1,
    "images": (b"a picture",),
}


def test_the_key_differs_for_each_changed_field():
    assert list(CHANGES) == [field.name for field in fields(Request)]
    keys = [request_key(MODEL, replace(REQUEST, **{name: value})) for name, value in CHANGES.items()]
    keys += [request_key(MODEL, REQUEST), request_key(MODEL + "-lite", REQUEST)]
    assert len(set(keys)) == 10


def test_the_order_of_a_schemas_properties_counts_and_its_kind_of_mapping_does_not():
    backwards = {**SCHEMA, "properties": dict(reversed(SCHEMA["properties"].items()))}
    assert backwards == SCHEMA
    assert request_key(MODEL, replace(REQUEST, schema=backwards)) != request_key(MODEL, REQUEST)
    frozen = MappingProxyType({**SCHEMA, "properties": MappingProxyType(SCHEMA["properties"])})
    assert request_key(MODEL, replace(REQUEST, schema=frozen, temperature=0)) == request_key(MODEL, REQUEST)


def test_the_key_of_a_request_never_changes():
    # sha256 of this text, as sha256sum gives it.
    text = (
        '{"format":"usd2kg-request/1","model":"m","request":{"system":"Classes","user":"caf\\u00e9","schema":'
        '{"type":"object"},"most_tokens":4096,"temperature":0.0,"is_thinking":false,"sample":0}}'
    )
    assert text.isascii()
    key = "sha256:9bd2d222fef61ceb551ebf79f01a37c80c14fbc81ffde6b01e22e501892dfb02"
    assert request_key("m", Request("Classes", "café", {"type": "object"})) == key


def test_the_key_of_a_request_with_images_is_that_of_their_digests():
    # sha256 of this text, as sha256sum gives it; the digest is that of "cup".
    text = (
        '{"format":"usd2kg-request/1","model":"m","request":{"system":"Classes","user":"cup","schema":{},'
        '"most_tokens":4096,"temperature":0.0,"is_thinking":false,"sample":0,"images":'
        '["c6171781d65f3ccce1135e3c89850cfbaa7f332fd72a1f8f6a841fbcf7fd362a"]}}'
    )
    assert text.isascii()
    key = "sha256:bc39f1b6c7ef0321ff0ba1294b50ff1d40239f32f739a183c10f6c8f1e9a9214"
    assert request_key("m", Request("Classes", "cup", {}, images=(b"cup",))) == key


def test_order_number_and_content_of_images_count():
    requests = [replace(REQUEST, images=images) for images in ((b"a",), (b"b",), (b"a", b"b"), (b"b", b"a"), (b"ab",))]
    assert len({request_key(MODEL, request) for request in requests}) == 5


def test_of_images_only_digests_are_kept(cache, tmp_path: Path):
    image = b"\x89PNG\r\n\x1a\n" + bytes(range(256))
    asked = replace(REQUEST, images=(image,))
    cache.put(MODEL, asked, COMPLETION)
    assert cache.get(MODEL, asked) == COMPLETION
    assert cache.get(MODEL, REQUEST) is None
    cache.export_recording(tmp_path / "said.jsonl")
    recorded = (tmp_path / "said.jsonl").read_bytes()
    assert json.loads(recorded)["request"]["images"] == [hashlib.sha256(image).hexdigest()]
    path = cache.path
    cache.close()
    for kept in (recorded, path.read_bytes()):
        assert image[8:40] not in kept
        assert base64.b64encode(image)[:40] not in kept
    with CompletionCache(tmp_path / "other.sqlite") as other:
        assert other.import_recording(tmp_path / "said.jsonl") == 1
        assert other.get(MODEL, asked) == COMPLETION
        other.export_recording(tmp_path / "again.jsonl")
    assert (tmp_path / "again.jsonl").read_bytes() == recorded


def test_a_schema_that_is_not_json_is_refused(cache):
    with pytest.raises(TypeError, match="set is not JSON"):
        cache.put(MODEL, replace(REQUEST, schema={"enum": {"Cup"}}), COMPLETION)
    with pytest.raises(ValueError, match="Out of range float"):
        cache.put(MODEL, replace(REQUEST, temperature=float("nan")), COMPLETION)
    assert len(cache) == 0


def _user(i: int) -> Request:
    return replace(REQUEST, user=f"/World/cup_{i}")


def _put_many(path: Path, name: str, start: threading.Event) -> None:
    start.wait(30)
    with CompletionCache(path) as cache:
        for i in range(100):
            cache.put(MODEL, _user(i), Completion(f"shared {i}"))
            cache.put(name, _user(i), Completion(f"{name} {i}"))
            assert cache.get(name, _user(i)) == Completion(f"{name} {i}")


def test_processes_that_start_at_once_share_a_new_cache(tmp_path: Path):
    path, start = tmp_path / "cache.sqlite", SPAWN.Event()
    names = ["one", "two", "three"]
    processes = [SPAWN.Process(target=_put_many, args=(path, name, start)) for name in names]
    for process in processes:
        process.start()
    start.set()
    for process in processes:
        process.join(60)
    assert [process.exitcode for process in processes] == [0, 0, 0]
    with CompletionCache(path) as cache:
        assert len(cache) == 400
        for i in range(100):
            assert cache.get(MODEL, _user(i)) == Completion(f"shared {i}")
            assert [cache.get(name, _user(i)) for name in names] == [Completion(f"{name} {i}") for name in names]


def _open_many(folder: Path, name: str, barrier: threading.Barrier) -> None:
    for i in range(40):
        barrier.wait(30)
        with CompletionCache(folder / f"{i}.sqlite") as cache:
            cache.put(name, REQUEST, COMPLETION)


def test_processes_that_make_the_same_file_at_once_wait_for_each_other(tmp_path: Path):
    barrier = SPAWN.Barrier(4)
    processes = [SPAWN.Process(target=_open_many, args=(tmp_path, name, barrier)) for name in "abcd"]
    for process in processes:
        process.start()
    for process in processes:
        process.join(60)
    assert [process.exitcode for process in processes] == [0, 0, 0, 0]
    for path in tmp_path.glob("*.sqlite"):
        with CompletionCache(path) as cache:
            assert len(cache) == 4


def test_threads_share_one_cache(cache):
    def put(name: str) -> None:
        for i in range(50):
            cache.put(name, _user(i), Completion(f"{name} {i}"))

    threads = [threading.Thread(target=put, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(cache) == 200
    assert cache.get("d", _user(49)) == Completion("d 49")


def test_threads_that_open_a_new_cache_at_once_share_it(tmp_path: Path):
    def put(name: str) -> None:
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            cache.put(name, REQUEST, COMPLETION)

    threads = [threading.Thread(target=put, args=(name,)) for name in "abcdefgh"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        assert len(cache) == 8


_PUTTER = """
import sys
from pathlib import Path
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Completion, Request
cache = CompletionCache(Path(sys.argv[1]))
for i in range(100_000):
    cache.put("m", Request("s", str(i), {}), Completion("x" * 5000 + str(i)))
    print(i, flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL")
@pytest.mark.parametrize("after", [1, 37, 150])
def test_a_killed_process_leaves_every_put_that_returned(tmp_path: Path, after: int):
    path = tmp_path / "cache.sqlite"
    process = subprocess.Popen([sys.executable, "-c", _PUTTER, str(path)], stdout=subprocess.PIPE, text=True)
    for _ in range(after):
        process.stdout.readline()
    process.send_signal(signal.SIGKILL)
    rest, _ = process.communicate()
    assert process.returncode == -signal.SIGKILL
    returned = after + rest.count("\n")
    with CompletionCache(path) as cache:
        assert returned <= len(cache) <= returned + 1
        for i in range(returned):
            assert cache.get("m", Request("s", str(i), {})) == Completion("x" * 5000 + str(i))
        cache.put(MODEL, REQUEST, COMPLETION)
    connection = sqlite3.connect(path)
    assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
    connection.close()


def test_a_run_that_waits_too_long_for_another_says_so(tmp_path: Path, monkeypatch):
    monkeypatch.setattr("usd2kg.grounding.llm.cache.LIMITS", replace(LIMITS, cache_busy_s=0.05))
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        other = sqlite3.connect(cache.path, isolation_level=None)
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(
            GroundingError, match=r"cache\.sqlite: .*database is locked.*end other programs that use it"
        ):
            cache.put(MODEL, REQUEST, COMPLETION)
        other.execute("ROLLBACK")
        other.close()
        cache.put(MODEL, REQUEST, COMPLETION)
        assert cache.get(MODEL, REQUEST) == COMPLETION


def test_a_file_that_is_no_database_is_left_as_it_is(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    path.write_bytes(b"not a database" * 100)
    with pytest.raises(GroundingError, match=r"cache\.sqlite: is damaged or no cache .*not a database.*move it away"):
        CompletionCache(path)
    assert path.read_bytes() == b"not a database" * 100


def test_the_database_of_another_program_is_left_as_it_is(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE bookmarks (url TEXT)")
    connection.close()
    before = path.read_bytes()
    with pytest.raises(GroundingError, match=r"cache\.sqlite: is the database of another program; move it away"):
        CompletionCache(path)
    assert path.read_bytes() == before


def test_a_cache_of_a_later_format_is_refused(cache):
    cache.close()
    connection = sqlite3.connect(cache.path)
    connection.execute("PRAGMA user_version = 3")
    connection.close()
    with pytest.raises(GroundingError, match="has format 3, expected 2; move it away"):
        CompletionCache(cache.path)


# As version 0.1.0 wrote it, by hand.
OLD_COMPLETION = (
    '{"text":"{\\"class\\": \\"Cup\\"} \\ud83d é","finish":"length","usage":{"input_tokens":12,"cached_tokens":8,'
    '"output_tokens":5},"mean_logprob":-0.25,"thinking":"A cup."}'
)
UPGRADED = Completion('{"class": "Cup"} \ud83d é', Finish.LENGTH, Usage(12, 8, 5), (), "A cup.")


def _age(path: Path, count: int) -> None:
    """Make a cache as an older version left it."""
    with CompletionCache(path) as cache:
        for i in range(count):
            cache.put(MODEL, _user(i), COMPLETION)
    connection = sqlite3.connect(path)
    with connection:
        connection.execute("UPDATE completions SET completion = ?", (OLD_COMPLETION,))
        connection.execute("PRAGMA user_version = 1")
    connection.close()


def test_a_cache_of_an_older_format_keeps_its_completions(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    _age(path, 3)
    for _ in range(2):
        with CompletionCache(path) as cache:
            assert len(cache) == 3
            assert [cache.get(MODEL, _user(i)) for i in range(3)] == [UPGRADED] * 3
            cache.put(MODEL, REQUEST, COMPLETION)
            assert cache.get(MODEL, REQUEST) == COMPLETION
            path = cache.path
        _forget(path, REQUEST)
    connection = sqlite3.connect(path)
    assert connection.execute("PRAGMA user_version").fetchone() == (2,)
    connection.close()


def _forget(path: Path, request: Request) -> None:
    connection = sqlite3.connect(path)
    with connection:
        connection.execute("DELETE FROM completions WHERE key = ?", (request_key(MODEL, request),))
    connection.close()


def test_threads_that_open_an_older_cache_at_once_share_it(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    _age(path, 50)
    found: list[Completion | None] = []

    def read() -> None:
        with CompletionCache(path) as cache:
            found.extend(cache.get(MODEL, _user(i)) for i in range(50))

    threads = [threading.Thread(target=read) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [UPGRADED] * 300


def test_a_damaged_completion_of_an_older_cache_stays_as_it_is(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    _age(path, 2)
    connection = sqlite3.connect(path)
    with connection:
        connection.execute("UPDATE completions SET completion = '{' WHERE key = ?", (request_key(MODEL, _user(0)),))
    connection.close()
    with CompletionCache(path) as cache:
        assert cache.get(MODEL, _user(1)) == UPGRADED
        with pytest.raises(GroundingError, match="is damaged"):
            cache.get(MODEL, _user(0))


def test_a_recording_of_an_older_format_is_imported(cache, tmp_path: Path):
    with CompletionCache(tmp_path / "other.sqlite") as other:
        other.put(MODEL, REQUEST, COMPLETION)
        other.export_recording(tmp_path / "other.jsonl")
    line = json.loads((tmp_path / "other.jsonl").read_text("utf-8"))
    line["completion"] = json.loads(OLD_COMPLETION)
    (tmp_path / "old.jsonl").write_text(json.dumps(line), "utf-8")
    assert cache.import_recording(tmp_path / "old.jsonl") == 1
    assert cache.get(MODEL, REQUEST) == UPGRADED


def test_damaged_pages_are_an_error_that_names_the_file(cache):
    for i in range(200):
        cache.put(MODEL, _user(i), COMPLETION)
    cache.close()
    data = bytearray(cache.path.read_bytes())
    data[4096:] = b"\xff" * (len(data) - 4096)
    cache.path.write_bytes(data)
    with (
        CompletionCache(cache.path) as damaged,
        pytest.raises(GroundingError, match=r"cache\.sqlite: is damaged .*malformed.*move it away"),
    ):
        damaged.get(MODEL, REQUEST)


@pytest.mark.parametrize("text", ["{", "[]", '{"text": "Cup"}'])
def test_a_damaged_completion_is_an_error_that_names_it(cache, text):
    cache.put(MODEL, REQUEST, COMPLETION)
    connection = sqlite3.connect(cache.path)
    with connection:
        connection.execute("UPDATE completions SET completion = ?", (text,))
    connection.close()
    with pytest.raises(GroundingError, match=rf"cache\.sqlite: completion {request_key(MODEL, REQUEST)} is damaged"):
        cache.get(MODEL, REQUEST)


def test_a_place_that_cannot_be_written_is_an_error(tmp_path: Path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(GroundingError, match=r"cannot be created .*set USD2KG_CACHE"):
        CompletionCache(tmp_path / "file" / "cache.sqlite")
    with pytest.raises(GroundingError, match=r"cannot be used .*unable to open"):
        CompletionCache(tmp_path)


def test_folders_are_made_and_the_file_is_the_users_own(tmp_path: Path):
    path = tmp_path / "a" / "b" / "cache.sqlite"
    with CompletionCache(path) as cache:
        cache.put(MODEL, REQUEST, COMPLETION)
        if os.name == "posix":
            assert {stat.S_IMODE(file.stat().st_mode) for file in path.parent.iterdir()} == {0o600}
    with CompletionCache(path) as cache:
        assert cache.get(MODEL, REQUEST) == COMPLETION


def test_a_recording_is_sorted_readable_and_the_same_whatever_the_order(tmp_path: Path):
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


def test_an_empty_cache_gives_an_empty_recording(cache, tmp_path: Path):
    assert cache.export_recording(tmp_path / "empty.jsonl") == 0
    assert (tmp_path / "empty.jsonl").read_bytes() == b""
    assert cache.import_recording(tmp_path / "empty.jsonl") == 0


def test_an_import_adds_what_is_new_and_keeps_what_is_there(cache, tmp_path: Path):
    with CompletionCache(tmp_path / "other.sqlite") as other:
        other.put(MODEL, REQUEST, Completion("theirs"))
        other.put(MODEL, _user(2), Completion("new"))
        other.export_recording(tmp_path / "other.jsonl")
    cache.put(MODEL, REQUEST, Completion("ours"))
    assert cache.import_recording(tmp_path / "other.jsonl") == 1
    assert cache.get(MODEL, REQUEST) == Completion("ours")
    assert cache.get(MODEL, _user(2)) == Completion("new")


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
def test_a_broken_line_is_named_and_nothing_is_imported(tmp_path: Path, name: str):
    breaking, message = BROKEN[name]
    path = tmp_path / "recording.jsonl"
    with CompletionCache(tmp_path / "a.sqlite") as cache:
        for i in range(3):
            cache.put(MODEL, _user(i), COMPLETION)
        cache.export_recording(path)
    lines = path.read_bytes().splitlines()
    path.write_bytes(b"\n".join([lines[0], breaking(lines[1]), lines[2]]))
    with CompletionCache(tmp_path / "b.sqlite") as cache:
        with pytest.raises(
            GroundingError, match=rf"recording\.jsonl: line 2 is no .*({message}).*nothing was imported"
        ):
            cache.import_recording(path)
        assert len(cache) == 0
        cache.put(MODEL, REQUEST, COMPLETION)
        assert len(cache) == 1


def test_a_recording_that_is_missing_or_cannot_be_written_is_an_error(cache, tmp_path: Path):
    with pytest.raises(GroundingError, match=r"none\.jsonl: cannot be read as a recording .*No such file"):
        cache.import_recording(tmp_path / "none.jsonl")
    with pytest.raises(OutputError, match="does not exist"):
        cache.export_recording(tmp_path / "none" / "out.jsonl")
    with pytest.raises(OutputError, match="is the cache itself"):
        cache.export_recording(cache.path)


def test_the_users_choice_comes_first(monkeypatch, tmp_path: Path):
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "mine"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert default_cache_path() == tmp_path / "mine"


def test_the_usual_place_is_the_users_cache_folder(monkeypatch, tmp_path: Path):
    monkeypatch.delenv("USD2KG_CACHE", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setattr("sys.platform", "linux")
    home = tmp_path / "home" / ".cache" / "usd2kg" / "completions.sqlite"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert default_cache_path() == tmp_path / "xdg" / "usd2kg" / "completions.sqlite"
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    assert default_cache_path() == home
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert default_cache_path() == home


def test_the_usual_place_on_windows(monkeypatch, tmp_path: Path):
    monkeypatch.delenv("USD2KG_CACHE", raising=False)
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path / "Local"))
    assert default_cache_path() == tmp_path / "Local" / "usd2kg" / "completions.sqlite"


def test_a_user_without_a_home_is_told_what_to_set(monkeypatch):
    def no_home() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("USD2KG_CACHE", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", no_home)
    with pytest.raises(GroundingError, match=r"home directory.*set USD2KG_CACHE"):
        default_cache_path()
