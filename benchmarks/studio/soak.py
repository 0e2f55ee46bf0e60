"""Measure whether the memory of the studio's server grows while a scene is reviewed.

Usage: python -m benchmarks.studio.soak [--scene SCENE] [--cycles 10000]

A cycle is a decision, the page of the next object and the queue; every third decision is undone. Every 50 cycles the
reviewer asks in English and in SPARQL, looks at a picture and exports the graph; every 500 cycles the open objects are
grounded again. A reviewer makes 10,000 decisions in eight hours of one decision in three seconds.
"""

import argparse
import time
from pathlib import Path

from benchmarks.studio.server import ask, fetch, studio
from usd2kg.demo import demo_scene

REVIEWER = {"reviewer": "benchmark"}
QUERY = "SELECT (COUNT(*) AS ?n) { ?s a ?class }"
REPORTS = 20


def resident_mib() -> int:
    """Return the resident memory of this process, MiB."""
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    kib = next(line for line in status.splitlines() if line.startswith("VmRSS"))
    return int(kib.split()[1]) // 1024


def run_cycle(address: str, number: int, count: int) -> None:
    """Send the requests of one cycle."""
    ask(address, "decisions", {**REVIEWER, "objects": [number % count], "action": "confirm"})
    ask(address, f"object/{(number + 1) % count}")
    ask(address, "queue")
    if number % 3 == 2:
        ask(address, "undo", REVIEWER)
    if number % 50 == 0:
        ask(address, "ask", {"question": "How many cups are there?"})
        ask(address, "sparql", {"query": QUERY})
        fetch(address, f"thumbnail/{number % count}.png")
        fetch(address, "export/graph.ttl")
    if number % 500 == 499:
        ask(address, "reground", REVIEWER)


def main() -> None:
    """Print the memory after every twentieth of the cycles."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--scene", type=Path, default=demo_scene())
    parser.add_argument("--cycles", type=int, default=10_000)
    options = parser.parse_args()
    with studio(options.scene) as address:
        count = len(ask(address, "states")["states"])
        start = time.perf_counter()
        print("| cycles | seconds | memory, MiB |\n| --- | --- | --- |")
        for number in range(options.cycles):
            run_cycle(address, number, count)
            if (number + 1) % max(1, options.cycles // REPORTS) == 0:
                print(f"| {number + 1:,} | {time.perf_counter() - start:.0f} | {resident_mib()} |", flush=True)


if __name__ == "__main__":
    main()
