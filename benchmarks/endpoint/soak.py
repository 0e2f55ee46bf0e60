"""Put `usd2kg serve` under load for minutes: errors that are not the client's, latency, memory.

Usage: python -m benchmarks.endpoint.soak [--minutes 10] [--clients 50] [--objects 2000]

Each client sends mixed requests one after the other: ready questions, wrong queries, bodies that are too long, queries
that are stopped, the page, and now and then it hangs up in the middle of an answer.
"""

import argparse
import json
import random
import re
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter, defaultdict
from http.client import HTTPConnection, HTTPException
from pathlib import Path
from urllib.parse import urlencode

from benchmarks.scale.stage import write_place

CROSS = "SELECT (COUNT(*) AS ?n) { ?a ?b ?c . ?d ?e ?f . ?g ?h ?i . ?j ?k ?l }"
EXPECTED = {
    "example": {200},
    "all objects": {200},
    "about": {200},
    "page": {200},
    "wrong query": {400},
    "long body": {413},
    # It is stopped, or refused since others wait.
    "endless query": {503},
    "hang up": {0},
}
WEIGHTS = {"example": 60, "all objects": 10, "about": 8, "page": 8, "wrong query": 6, "long body": 3, "hang up": 4}
"""Kind of request → how often; endless queries are sent by one client alone, since they take all workers."""


class Client(threading.Thread):
    """Sends requests until the end, and keeps what came back."""

    def __init__(self, port: int, examples: list[str], end: float, seed: int) -> None:
        super().__init__(daemon=True)
        self.times: dict[str, list[float]] = defaultdict(list)
        self.statuses: Counter[tuple[str, int]] = Counter()
        self.problems: list[str] = []
        self.refusals: Counter[str] = Counter()
        self._port, self._examples, self._end, self._chance = port, examples, end, random.Random(seed)
        self._is_nasty = seed == 0

    def run(self) -> None:
        """Send requests."""
        while time.monotonic() < self._end:
            kinds, weights = zip(*WEIGHTS.items(), strict=True)
            kind = "endless query" if self._is_nasty else self._chance.choices(kinds, weights)[0]
            start = time.monotonic()
            try:
                status = self._send(kind)
            except (OSError, HTTPException) as error:
                self.problems.append(f"{kind}: {type(error).__name__} {error}")
                continue
            self.statuses[kind, status] += 1
            if status in EXPECTED[kind]:
                self.times[kind].append(time.monotonic() - start)
            if self._is_nasty:
                time.sleep(20)

    def _send(self, kind: str) -> int:
        if kind == "hang up":
            return self._hang_up()
        query = {
            "example": self._chance.choice(self._examples),
            "all objects": "SELECT * { ?o u2k:primPath ?p }",
            "wrong query": "SELECT * {",
            "endless query": CROSS,
        }.get(kind)
        connection = HTTPConnection("127.0.0.1", self._port, timeout=60)
        try:
            if kind == "long body":
                headers = {"Content-Type": "application/sparql-query"}
                connection.request("POST", "/sparql", b"#" * 2_000_000, headers)
            else:
                path = {"about": "/about", "page": "/"}.get(kind, f"/sparql?{urlencode({'query': query or ''})}")
                connection.request("GET", path)
            reply = connection.getresponse()
            text = reply.read()
            if reply.status not in EXPECTED[kind]:
                self.refusals[text.decode("utf-8", "replace").strip()[:100]] += 1
            # As well-behaved clients do when the queue is full.
            time.sleep(float(reply.headers.get("Retry-After", "0")))
            return reply.status
        except (BrokenPipeError, ConnectionResetError):
            # The server answers a body that is too long before it has read all of it.
            if kind == "long body":
                return 413
            raise
        finally:
            connection.close()

    def _hang_up(self) -> int:
        with socket.create_connection(("127.0.0.1", self._port), timeout=60) as open_socket:
            target = f"/sparql?{urlencode({'query': 'SELECT * { ?s ?p ?o }'})}"
            open_socket.sendall(f"GET {target} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())
            open_socket.recv(100)
        return 0


def memory_mib(pid: int) -> float:
    """Return the resident memory of a process and its children."""
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text("ascii").split()
    found = 0.0
    for each in (pid, *map(int, children)):
        try:
            found += int(Path(f"/proc/{each}/statm").read_text("ascii").split()[1]) * 4096 / 2**20
        except OSError:
            continue
    return found


def main() -> None:
    """Run the clients, and print what they saw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--clients", type=int, default=50)
    parser.add_argument("--objects", type=int, default=2000)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        stage, graph = Path(temporary) / "place.usda", Path(temporary) / "place.ttl"
        write_place(stage, "flats", asked.objects)
        usd2kg = [sys.executable, "-m", "usd2kg"]
        subprocess.run([*usd2kg, "build", str(stage), "-o", str(graph)], check=True, capture_output=True)
        log = (Path(temporary) / "log").open("w+")
        with subprocess.Popen([*usd2kg, "serve", str(graph), "--port", "0"], stderr=log) as server:
            port = wait_for_port(Path(log.name))
            try:
                measure(asked, server.pid, port)
            finally:
                server.terminate()
        print(f"log: {len(Path(log.name).read_bytes()):,} bytes")
        log.close()


def wait_for_port(log: Path) -> int:
    """Return the port once the server says that it is ready."""
    for _ in range(600):
        if found := re.search(r"http://127\.0\.0\.1:(\d+)", log.read_text()):
            return int(found[1])
        time.sleep(0.1)
    raise SystemExit(f"the server did not start: {log.read_text()}")


def measure(asked: argparse.Namespace, pid: int, port: int) -> None:
    """Run the clients."""
    connection = HTTPConnection("127.0.0.1", port, timeout=60)
    connection.request("GET", "/about")
    examples = [example["query"] for example in json.loads(connection.getresponse().read())["examples"]]
    end = time.monotonic() + 60 * asked.minutes
    clients = [Client(port, examples, end, seed) for seed in range(asked.clients)]
    for client in clients:
        client.start()
    memory = [memory_mib(pid)]
    while time.monotonic() < end:
        time.sleep(max(1.0, 6 * asked.minutes))
        memory.append(memory_mib(pid))
    for client in clients:
        client.join(90)
    statuses = sum((client.statuses for client in clients), Counter[tuple[str, int]]())
    print("| request | count | median ms | p99 ms | other statuses |\n| --- | --- | --- | --- | --- |")
    for kind, expected in EXPECTED.items():
        times = sorted(1000 * t for client in clients for t in client.times[kind])
        other = {status: n for (name, status), n in statuses.items() if name == kind and status not in expected}
        if times:
            p99 = times[min(len(times) - 1, int(0.99 * len(times)))]
            print(f"| {kind} | {len(times)} | {statistics.median(times):.0f} | {p99:.0f} | {other or ''} |")
    problems = Counter(problem for client in clients for problem in client.problems)
    print(f"{sum(statuses.values())} requests of {asked.clients} clients in {asked.minutes:g} min")
    print(f"without an answer: {dict(problems) or 'none'}")
    refusals = sum((client.refusals for client in clients), Counter[str]())
    print(f"refused: {dict(refusals) or 'none'}")
    print(f"memory of the server and its workers, MiB: {', '.join(f'{value:.0f}' for value in memory)}")


if __name__ == "__main__":
    main()
