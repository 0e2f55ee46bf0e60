"""Planted secrets are found in no output, log, cache or recording."""

import gzip
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.grounding.llm.bedrock_server import converse_reply
from tests.grounding.llm.connections import locate
from tests.grounding.llm.servers import Reply, anthropic_reply, gemini_reply, openai_reply, refuse, serve

SECRETS = {
    name: f"planted-{number}-Zx81-{name.lower()}"
    for number, name in enumerate(
        (
            *("OPENAI_API_KEY", "GOOGLE_API_KEY", "GEMINI_API_KEY", "ANTHROPIC_API_KEY", "AZURE_OPENAI_API_KEY"),
            *("AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY", "AWS_SESSION_TOKEN"),
            *("USD2KG_STORE_USER", "USD2KG_STORE_PASSWORD", "USD2KG_STORE_TOKEN", "USD2KG_STUDIO_PASSWORD"),
        )
    )
}
SERVICES: dict[str, Callable[[str], Reply]] = {
    "google:gemini-2.5-flash": gemini_reply,
    "anthropic:claude-haiku-4-5": anthropic_reply,
    "azure:gpt-4o": openai_reply,
    "bedrock:us.anthropic.claude-haiku-4-5-20251001-v1:0": converse_reply,
}
KEYS = [secret for name, secret in SECRETS.items() if not name.startswith("USD2KG")]
"""The secrets that services of language models get."""
ECHO = json.dumps({"1": {"class": "Cup", "reasoning": " ".join(KEYS)}})
"""An answer that repeats them."""


class Shell:
    """Calls of usd2kg in a folder, with all secrets in the environment."""

    def __init__(self, folder: Path) -> None:
        self.folder, self._home = folder / "work", folder / "home"
        self.folder.mkdir()
        home = {"HOME": str(self._home), "XDG_CACHE_HOME": str(self._home / "cache")}
        self.environment = {**os.environ, **SECRETS, **home, "AWS_REGION": "eu-west-1"}
        # A store takes a token, or a user with a password.
        del self.environment["USD2KG_STORE_TOKEN"]
        self._said: list[str] = []

    def __call__(self, *arguments: object, code: int = 0) -> None:
        done = subprocess.run(
            [sys.executable, "-m", "usd2kg", *map(str, arguments), "--verbose"],
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
            env=self.environment,
            cwd=self.folder,
        )
        assert done.returncode == code, done.stderr
        self._said.extend((done.stdout, done.stderr))

    def check(self) -> None:
        """Look for the secrets in all files and outputs."""
        files = [path for root in (self.folder, self._home) for path in root.rglob("*") if path.is_file()]
        assert files
        contents = [(path, path.read_bytes()) for path in files]
        written = [(str(path), gzip.decompress(data) if path.suffix == ".gz" else data) for path, data in contents]
        for place, content in (*written, *(("output", text.encode()) for text in self._said)):
            for name, secret in SECRETS.items():
                assert secret.encode() not in content, f"{name} is in {place}"


@pytest.fixture
def usd2kg(tmp_path: Path) -> Shell:
    return Shell(tmp_path)


@pytest.mark.slow
def test_no_secret_is_written_anywhere(usd2kg: Shell, room: Path):
    with serve(openai_reply(ECHO, tokens=[(ECHO, -0.1)], thinking=ECHO)) as server:
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
    usd2kg.check()


@pytest.mark.slow
def test_an_evaluation_writes_no_secret(usd2kg: Shell, room: Path):
    (usd2kg.folder / "gold.csv").write_text("path,class\n/Room/coffee_mug,Cup\n", encoding="utf-8")
    with serve(openai_reply(ECHO)) as server:
        model = f"llm-C:openai:test@{server.url}/v1"
        scene = f'[[scene]]\nname = "room"\npath = "{room}"\ngold = "gold.csv"\n'
        matrix = f'grounders = ["{model}"]\nregimes = ["semantic"]\n{scene}'
        (usd2kg.folder / "matrix.toml").write_text(matrix, encoding="utf-8")
        usd2kg("eval", "run", room, "--gold", "gold.csv", "--grounder", model, "--output", "run.json")
        usd2kg("eval", "reproduce", "matrix.toml", "-o", "results", "--price", "1/2")
        assert server.received
    assert (usd2kg.folder / "results/recording.jsonl.gz").exists()
    usd2kg.check()


@pytest.mark.slow
@pytest.mark.parametrize("model", SERVICES)
def test_a_service_that_repeats_the_keys(usd2kg: Shell, room: Path, model: str):
    for code, reply in ((0, SERVICES[model](ECHO)), (2, refuse(403, ECHO))):
        with serve(reply) as server:
            usd2kg.environment |= dict.fromkeys(
                ("AZURE_OPENAI_ENDPOINT", "AWS_ENDPOINT_URL_BEDROCK_RUNTIME"), server.url
            )
            grounder = ("--grounder", f"llm-concept:{locate(model, server.url)}", "--refresh")
            files = ("-o", f"{code}.csv", "--queue", f"{code}.queue.csv", "--write-alignment", f"{code}.tsv")
            usd2kg("ground", room, *grounder, *files, code=code)
            assert server.received
            assert not any(secret in json.dumps(request.body) for request in server.received for secret in KEYS)
    usd2kg.check()
