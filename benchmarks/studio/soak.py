"""Measure whether the memory of the studio's server grows while a scene is reviewed.

Usage: python -m benchmarks.studio.soak [--scene SCENE] [--hours 8] [--reopenings 100]

A reviewer acts 20 times a minute: decides, looks at the next object and the queue, takes every third decision back and
makes half of those again. Every 50 acts he asks in English and in SPARQL, looks at a picture and exports the graph;
every 90 acts he loads the page again, with all meshes; every 500 acts he grounds the open objects again. Then the
project is closed and opened again in the same process, time after time.
"""

import argparse
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from benchmarks.intervals import slope
from benchmarks.studio.server import ask, fetch, listen, studio
from usd2kg.demo import demo_scene

REVIEWER = {"reviewer": "benchmark"}
QUERY = "SELECT (COUNT(*) AS ?n) { ?s a ?class }"
ACTS_PER_MINUTE = 20
SAMPLE_ACTS = 20
REPORTS = 20


def resident_mib() -> float:
    """Return the resident memory of this process, MiB."""
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    kib = next(line for line in status.splitlines() if line.startswith("VmRSS"))
    return int(kib.split()[1]) / 1024


def load_page(address: str) -> None:
    """Send the requests of a page that is loaded and closed again."""
    for path in ("scene", "states?reviewer=benchmark", "queue", "examples"):
        ask(address, path)
    for number in range(len(ask(address, "geometry")["chunks"])):
        fetch(address, f"geometry/{number}.glb")
    listen(address)


def act(address: str, number: int, count: int) -> int:
    """Send the requests of one decision and what belongs to it; return the number of acts: it, undo, redo."""
    acts = 1
    ask(address, "decisions", {**REVIEWER, "objects": [number % count], "action": "confirm"})
    ask(address, f"object/{(number + 1) % count}")
    ask(address, "queue")
    if number % 3 == 2:
        ask(address, "undo", REVIEWER)
        acts += 1
    if number % 6 == 5:
        ask(address, "redo", REVIEWER)
        acts += 1
    if number % 50 == 0:
        ask(address, "ask", {"question": "How many cups are there?"})
        ask(address, "sparql", {"query": QUERY})
        fetch(address, f"thumbnail/{number % count}.png")
        fetch(address, "export/graph.ttl")
        acts += 4
    if number % 90 == 0:
        load_page(address)
        acts += 1
    if number % 500 == 499:
        ask(address, "reground", REVIEWER)
        acts += 1
    return acts


def report(unit: str, counts: Sequence[int], memory: Sequence[float]) -> None:
    """Print the growth over the second half."""
    half = len(counts) // 2
    found = slope(np.array(counts[half:], float), np.array(memory[half:]))
    least, most = (1000 * bound for bound in found.interval)
    print(
        f"Second half: {1000 * found.value:+.2f} MiB per 1,000 {unit}, 95 % interval {least:+.2f} to {most:+.2f}; "
        f"{memory[half]:.1f} MiB, then {memory[-1]:.1f}",
        flush=True,
    )


def watch(
    unit: str,
    total: int,
    step: Callable[[int], int],
    sample: int,
    measure: Callable[[], float] = resident_mib,
) -> None:
    """Call a step until its counts reach the total; print the memory over time, and its growth.

    Args:
        unit: what is counted.
        total: the count to reach.
        step: takes its number, returns how much it counts.
        sample: count between two measurements.
        measure: returns the memory, MiB.
    """
    start, done, counts, memory = time.perf_counter(), 0, [], []
    print(f"| {unit} | seconds | memory, MiB |\n| --- | --- | --- |")
    number = 0
    while done < total:
        before = done
        done += step(number)
        number += 1
        if done // sample > before // sample:
            counts.append(done)
            memory.append(measure())
        if done * REPORTS // total > before * REPORTS // total:
            print(
                f"| {done:,} | {time.perf_counter() - start:.0f} | {memory[-1] if memory else measure():.1f} |",
                flush=True,
            )
    report(unit, counts, memory)


def main() -> None:
    """Print the memory over time, and how fast it grows."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--scene", type=Path, default=demo_scene())
    parser.add_argument("--hours", type=float, default=8)
    parser.add_argument("--reopenings", type=int, default=100)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        project = Path(folder) / "project"
        with studio(options.scene, project) as address:
            count = len(ask(address, "states")["states"])
            total = round(60 * options.hours * ACTS_PER_MINUTE)
            watch("acts", total, lambda number: act(address, number, count), SAMPLE_ACTS)

        def reopen(number: int) -> int:
            with studio(options.scene, project) as address:
                load_page(address)
                act(address, 50 * number, count)
            return 1

        if options.reopenings:
            watch("reopenings", options.reopenings, reopen, 1)


if __name__ == "__main__":
    main()
