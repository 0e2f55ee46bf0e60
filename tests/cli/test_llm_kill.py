"""A run with a language model that is killed loses no answer that it has paid for."""

import csv
import json
import os
import signal
import subprocess
import sys
import threading
from collections import Counter
from itertools import count
from pathlib import Path

import pytest

from tests.grounding.llm.servers import FakeServer, Received, Reply, openai_reply
from tests.scene.usda import component, cube, xform
from usd2kg.grounding.llm.cache import CompletionCache

KILLS = 20
WORKERS = 4
OBJECTS = WORKERS * (KILLS + 1)


class KillingServer(FakeServer):
    """Answers the first prompt of each worker, and kills the client when all workers wait for the next answers.

    Then no answer is on its way: each worker has finished the first prompt before it sends the next.
    """

    def __init__(self) -> None:
        super().__init__(openai_reply(json.dumps({"1": {"class": "Cup"}})))
        self.answered: Counter[str] = Counter()
        """Prompt → number of answers."""
        self.client: subprocess.Popen[bytes] | None = None
        self.start_run()

    def start_run(self) -> None:
        """Expect a new client."""
        self.numbers = count()
        self.rounds = [threading.Barrier(WORKERS), threading.Barrier(WORKERS, self.kill)]

    def kill(self) -> None:
        assert self.client is not None
        os.kill(self.client.pid, signal.SIGKILL)

    def _take(self, received: Received) -> Reply:
        reply = super()._take(received)
        turn = next(self.numbers) // WORKERS
        self.rounds[turn].wait(timeout=120)
        if turn:
            return Reply(hangs=True)
        with self._lock:
            self.answered[received.body["messages"][-1]["content"]] += 1
        return reply


@pytest.mark.slow
def test_kill_9_at_twenty_moments_loses_no_paid_answer(write_stage, tmp_path: Path):
    objects = (component(f"mug_{number}", cube("mesh", size=0.1)) for number in range(OBJECTS))
    scene = write_stage(xform("Kitchen", *objects))
    cache, output = tmp_path / "completions.sqlite", tmp_path / "classes.csv"
    server = KillingServer()
    arguments = ("ground", scene, "--grounder", f"llm-A:openai:test@{server.url}/v1", "--each-object", "-o", output)
    command = [sys.executable, "-m", "usd2kg", *map(str, arguments), "--completions", str(cache)]
    environment = {**os.environ, "OPENAI_API_KEY": "planted-key"}
    try:
        for run in range(KILLS + 1):
            server.start_run()
            with subprocess.Popen(command, env=environment, stderr=subprocess.PIPE) as client:
                server.client = client
                _, said = client.communicate(timeout=300)
            assert client.returncode == (-signal.SIGKILL if run < KILLS else 0), said.decode()
            with CompletionCache(cache) as stored:
                assert len(stored) == WORKERS * (run + 1)
    finally:
        server.close()
    assert len(server.answered) == OBJECTS
    assert set(server.answered.values()) == {1}, "no prompt is paid twice"
    with output.open(encoding="utf-8", newline="") as file:
        classes = [row["class"].rpartition("#")[2] for row in csv.DictReader(file)]
    assert classes == ["Cup"] * OBJECTS
