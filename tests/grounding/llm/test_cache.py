"""The completion cache: storage, invalid files, and its default path."""

import os
import sqlite3
import stat
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.llm.completions import COMPLETION, MODEL, REQUEST, request_about
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.serialization import request_key


@pytest.fixture
def cache(tmp_path: Path):
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        yield cache


# Truncated names can contain half a surrogate pair.
TEXTS = st.text(st.characters(), max_size=40) | st.sampled_from(
    ["\x00", "a\x00b", "\ud83d", "🍴", "\u2028", '\\ud83d"', ""]
)


COUNTS = st.integers(0, 2**70)


TOKENS_OF_A_TEXT = st.lists(st.tuples(TEXTS, st.floats(max_value=0, allow_nan=False)), max_size=4).map(tuple)


@settings(max_examples=150, deadline=None)
@given(
    request=st.builds(
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
    completion=st.builds(
        Completion,
        TEXTS,
        st.sampled_from(Finish),
        st.builds(Usage, COUNTS, COUNTS, COUNTS, COUNTS, COUNTS),
        TOKENS_OF_A_TEXT,
        TEXTS,
    ),
    model=TEXTS,
)
def test_round_trips_every_field_through_cache_and_recording(tmp_path_factory, model, request, completion):
    folder = tmp_path_factory.mktemp("cache")
    with CompletionCache(folder / "a.sqlite") as first, CompletionCache(folder / "b.sqlite") as second:
        first.put(model, request, completion)
        assert first.get(model, request) == completion
        assert first.export_recording(folder / "a.jsonl") == 1
        assert second.import_recording(folder / "a.jsonl") == 1
        assert second.get(model, request) == completion
        second.export_recording(folder / "b.jsonl")
    assert (folder / "a.jsonl").read_bytes() == (folder / "b.jsonl").read_bytes()


def test_joins_the_halves_of_a_surrogate_pair(cache):
    cache.put(MODEL, replace(REQUEST, user="\ud83d\ude00"), Completion("\ud83d\ude00"))
    assert cache.get(MODEL, replace(REQUEST, user="😀")) == Completion("😀")


def test_reads_back_an_integer_logprob(cache):
    cache.put(MODEL, REQUEST, Completion("x", tokens=(("x", 0),)))
    assert cache.get(MODEL, REQUEST) == Completion("x", tokens=(("x", 0.0),))


def test_returns_none_for_an_unknown_request(cache):
    cache.put(MODEL, REQUEST, COMPLETION)
    assert cache.get(MODEL, replace(REQUEST, sample=1)) is None
    assert cache.get("google:gemini-3-flash", REQUEST) is None


def test_keeps_the_first_completion_unless_replaced(cache):
    cache.put(MODEL, REQUEST, COMPLETION)
    cache.put(MODEL, REQUEST, Completion("second"))
    assert cache.get(MODEL, REQUEST) == COMPLETION
    cache.put(MODEL, REQUEST, Completion("third"), replace=True)
    assert cache.get(MODEL, REQUEST) == Completion("third")
    assert len(cache) == 1


def test_stores_a_shared_system_prompt_once(cache):
    system = "".join(f"class number {i}\n" for i in range(6000))
    for i in range(100):
        cache.put(MODEL, replace(REQUEST, system=system, user=f"/World/cup_{i}"), COMPLETION)
    path = cache.path
    cache.close()
    assert len(system) > 100_000
    assert path.stat().st_size < 2 * len(system)


def test_rejects_requests_that_are_not_json(cache):
    with pytest.raises(TypeError, match="set is not JSON"):
        cache.put(MODEL, replace(REQUEST, schema={"enum": {"Cup"}}), COMPLETION)
    with pytest.raises(ValueError, match="Out of range float"):
        cache.put(MODEL, replace(REQUEST, temperature=float("nan")), COMPLETION)
    assert len(cache) == 0


def test_rejects_a_file_that_is_not_a_database_without_changing_it(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    path.write_bytes(b"not a database" * 100)
    with pytest.raises(GroundingError, match=r"cache\.sqlite: is damaged or is not a cache .*not a database.*move it"):
        CompletionCache(path)
    assert path.read_bytes() == b"not a database" * 100


def test_rejects_a_foreign_database_without_changing_it(tmp_path: Path):
    path = tmp_path / "cache.sqlite"
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE bookmarks (url TEXT)")
    connection.close()
    before = path.read_bytes()
    with pytest.raises(GroundingError, match=r"cache\.sqlite: is the database of another program; move it away"):
        CompletionCache(path)
    assert path.read_bytes() == before


def test_rejects_a_newer_format(cache):
    cache.close()
    connection = sqlite3.connect(cache.path)
    connection.execute("PRAGMA user_version = 3")
    connection.close()
    with pytest.raises(GroundingError, match="has format 3, expected 2; move it away"):
        CompletionCache(cache.path)


def test_reports_damaged_pages_with_the_file(cache):
    for i in range(200):
        cache.put(MODEL, request_about(i), COMPLETION)
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
def test_reports_a_damaged_completion_with_its_key(cache, text):
    cache.put(MODEL, REQUEST, COMPLETION)
    connection = sqlite3.connect(cache.path)
    with connection:
        connection.execute("UPDATE completions SET completion = ?", (text,))
    connection.close()
    with pytest.raises(GroundingError, match=rf"cache\.sqlite: completion {request_key(MODEL, REQUEST)} is damaged"):
        cache.get(MODEL, REQUEST)


def test_reports_a_path_that_is_not_writable(tmp_path: Path):
    (tmp_path / "file").write_text("x")
    with pytest.raises(GroundingError, match=r"cannot be created .*set USD2KG_CACHE"):
        CompletionCache(tmp_path / "file" / "cache.sqlite")
    with pytest.raises(GroundingError, match=r"cannot be used .*unable to open"):
        CompletionCache(tmp_path)


def test_creates_folders_and_a_private_file(tmp_path: Path):
    path = tmp_path / "a" / "b" / "cache.sqlite"
    with CompletionCache(path) as cache:
        cache.put(MODEL, REQUEST, COMPLETION)
        if os.name == "posix":
            assert {stat.S_IMODE(file.stat().st_mode) for file in path.parent.iterdir()} == {0o600}
    with CompletionCache(path) as cache:
        assert cache.get(MODEL, REQUEST) == COMPLETION


def test_usd2kg_cache_sets_the_default_path(monkeypatch, tmp_path: Path):
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "mine"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert default_cache_path() == tmp_path / "mine"


def test_default_path_is_in_the_xdg_cache_folder(monkeypatch, tmp_path: Path):
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


def test_default_path_on_windows_is_in_localappdata(monkeypatch, tmp_path: Path):
    monkeypatch.delenv("USD2KG_CACHE", raising=False)
    monkeypatch.setattr("sys.platform", "win32")
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path / "Local"))
    assert default_cache_path() == tmp_path / "Local" / "usd2kg" / "completions.sqlite"


def test_reports_a_missing_home_folder(monkeypatch):
    def no_home() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("USD2KG_CACHE", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", no_home)
    with pytest.raises(GroundingError, match=r"home directory.*set USD2KG_CACHE"):
        default_cache_path()


def test_opens_only_an_existing_cache_if_it_may_not_create_one(tmp_path: Path):
    path = tmp_path / "folder" / "cache.sqlite"
    with pytest.raises(GroundingError) as caught:
        CompletionCache(path, creates=False)
    assert str(caught.value) == f"{path}: no such cache of completions; correct --completions or USD2KG_CACHE"
    assert not path.parent.exists()
    CompletionCache(path).close()
    CompletionCache(path, creates=False).close()
