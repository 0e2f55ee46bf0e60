"""Planted secrets are found in no output, log, cache or recording."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.grounding.llm.servers import openai_reply, refuse, serve

SECRETS = {
    name: f"planted-{number}-Zx81-{name.lower()}"
    for number, name in enumerate(
        (
            *("OPENAI_API_KEY", "GOOGLE_API_KEY", "GEMINI_API_KEY", "ANTHROPIC_API_KEY"),
            *("USD2KG_STORE_USER", "USD2KG_STORE_PASSWORD", "USD2KG_STORE_TOKEN", "USD2KG_STUDIO_PASSWORD"),
        )
    )
}


@pytest.mark.slow
def test_no_secret_is_written_anywhere(room: Path, tmp_path: Path):
    folder = tmp_path / "work"
    folder.mkdir()
    home = tmp_path / "home"
    secrets = dict(SECRETS)
    # A store takes a token, or a user with a password.
    del secrets["USD2KG_STORE_TOKEN"]
    environment = {**os.environ, **secrets, "HOME": str(home), "XDG_CACHE_HOME": str(home / "cache")}
    said: list[str] = []

    def usd2kg(*arguments: object, code: int = 0) -> None:
        done = subprocess.run(
            [sys.executable, "-m", "usd2kg", *map(str, arguments), "--verbose"],
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
            env=environment,
            cwd=folder,
        )
        assert done.returncode == code, done.stderr
        said.extend((done.stdout, done.stderr))

    echo = json.dumps({"1": {"class": "Cup", "reasoning": f"by {SECRETS['OPENAI_API_KEY']}"}})
    with serve(openai_reply(echo, tokens=[(echo, -0.1)], thinking=echo)) as server:
        model = f"llm-A:openai:test@{server.url}/v1"
        usd2kg("build", room, "-o", "llm.ttl", "--grounder", model)
        assert server.received[0].headers["authorization"] == f"Bearer {SECRETS['OPENAI_API_KEY']}", "the key was used"
    with serve(refuse(401, f"wrong key {SECRETS['OPENAI_API_KEY']}")) as server:
        usd2kg("build", room, "-o", "failed.ttl", "--grounder", f"llm-A:openai:test@{server.url}/v1", code=2)
    usd2kg("build", room, "-o", "plain.ttl", "--store", "store")
    usd2kg("ground", room, "-o", "mapping.sssom.tsv")
    usd2kg("label", "write", room, "plain.ttl", "-o", "labels.usda")
    usd2kg("batch", room, "-o", "batch")
    usd2kg("query", "plain.ttl", "--sparql", "ASK { ?s ?p ?o }")
    usd2kg("doctor", "--json")
    usd2kg("completions", "export", "recording.json")

    files = [path for root in (folder, home) for path in root.rglob("*") if path.is_file()]
    assert len(files) > 8
    written = [(str(path), path.read_bytes()) for path in files]
    written += [("output", text.encode()) for text in said]
    for place, content in written:
        for name, secret in secrets.items():
            assert secret.encode() not in content, f"{name} is in {place}"
