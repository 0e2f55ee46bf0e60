"""Time the whole pipeline from file to graph on furnished flats, a warehouse and a twin, and how it grows with size.

Usage: python -m benchmarks.scale.run [OBJECTS...] [--places flats warehouse twin] [--profiles soma plain]

The default is 1000, 10000 and 100000 objects of four to five prims each. Each run has its own process, for its peak
memory. Seconds are processor time, with that of forked processes, which other load affects little; wall time is in
brackets. The floor is the processor time to open and traverse the stage with OpenUSD alone, in its own process. "Ours /
its own" compares writing Turtle with pyoxigraph's serialiser on the same triples, alternately. The exponent is the
slope of log seconds over log objects: 1 is linear.
"""

import argparse
import json
import math
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from benchmarks.scale.places import PLACES

TWIN = "twin"
"""Instances of one prototype whose names say nothing."""
STEPS = ("read", "ground", "relations", "instantiate", "write", "total")
TURNS = 3


class Clock:
    """Processor time and wall time of each step in seconds."""

    def __init__(self) -> None:
        self.cpu: dict[str, float] = {}
        self.wall: dict[str, float] = {}

    def step(self, name: str, action: Callable[[], Any]) -> Any:
        """Return the result of an action and record its times."""
        cpu, wall = processor_time(), time.perf_counter()
        result = action()
        self.cpu[name], self.wall[name] = processor_time() - cpu, time.perf_counter() - wall
        return result


def processor_time() -> float:
    """Return the seconds of processor time of this process and of its children that have ended."""
    used = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in used)


def peak_memory() -> float:
    """Return the peak memory in GB; on Linux child processes inherit `ru_maxrss`, hence `/proc`."""
    status = Path("/proc/self/status")
    if status.exists():
        fields = dict(line.split(":", 1) for line in status.read_text().splitlines())
        return int(fields["VmHWM"].split()[0]) * 1024 / 1e9
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e9


def measure(stage: Path, profile: str) -> dict[str, Any]:
    """Return the times of each step on one stage."""
    from usd2kg.graph import instantiate, write_graph  # noqa: PLC0415 - only in the child processes
    from usd2kg.grounding import ground  # noqa: PLC0415
    from usd2kg.ontology import load_home_tbox  # noqa: PLC0415
    from usd2kg.relations import find_relations  # noqa: PLC0415 - only in the child processes
    from usd2kg.scene import read_scene  # noqa: PLC0415

    clock = Clock()
    scene = clock.step("read", lambda: read_scene(stage))
    tbox = load_home_tbox()
    grounding = clock.step("ground", lambda: ground(scene, tbox, "lexical"))
    found = clock.step("relations", lambda: find_relations(scene, tbox, grounding))
    graph = clock.step("instantiate", lambda: instantiate(scene, tbox, grounding, profile=profile, relations=found))
    target = stage.with_suffix(".ttl")
    clock.step("write", lambda: write_graph(graph, target))
    peak = peak_memory()
    for seconds in (clock.cpu, clock.wall):
        seconds["total"] = sum(seconds.values())
    return {
        "prims": scene.prim_count,
        "triples": len(graph.triples),
        "relations": len(found),
        "cpu": clock.cpu,
        "wall": clock.wall,
        "peak": peak,
        "ratio": serialiser_ratio(graph, target),
    }


def measure_floor(stage: Path) -> dict[str, float]:
    """Return the processor time to open a stage and traverse its prims, with those of instances, by OpenUSD alone."""
    start = processor_time()
    from pxr import Usd  # noqa: PLC0415 - counts

    opened = Usd.Stage.Open(str(stage))
    prims = sum(1 for _ in opened.Traverse(Usd.TraverseInstanceProxies()))
    return {"seconds": processor_time() - start, "prims": prims}


def serialiser_ratio(graph: Any, target: Path) -> float:
    """Return the ratio of our serialisation time to that of pyoxigraph on the same triples."""
    import pyoxigraph as ox  # noqa: PLC0415

    from usd2kg.graph import write_graph  # noqa: PLC0415

    turtle = ox.RdfFormat.TURTLE
    ours, own = Clock(), Clock()
    times = []
    for _ in range(TURNS):
        ours.step("write", lambda: write_graph(graph, target))
        own.step("write", lambda: ox.serialize(graph.triples, str(target), format=turtle, prefixes=graph.prefixes))
        times.append((ours.cpu["write"], own.cpu["write"]))
    return min(mine for mine, _ in times) / min(theirs for _, theirs in times)


def exponent(sizes: list[int], seconds: list[float]) -> float:
    """Return the slope of log seconds over log size, by least squares: 1 is linear."""
    x, y = [math.log(size) for size in sizes], [math.log(max(value, 1e-4)) for value in seconds]
    middle_x, middle_y = sum(x) / len(x), sum(y) / len(y)
    spread = sum((value - middle_x) ** 2 for value in x)
    return sum((a - middle_x) * (b - middle_y) for a, b in zip(x, y, strict=True)) / spread


def run_child(*arguments: str) -> dict[str, Any]:
    """Return what this program measures in a separate process."""
    command = [sys.executable, "-m", "benchmarks.scale.run", *arguments]
    found = subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    measured: dict[str, Any] = json.loads(found.stdout)
    return measured


def print_row(place: str, profile: str, objects: int, measured: dict[str, Any]) -> None:
    """Print one run as a table row."""
    steps = " | ".join(f"{measured['cpu'][step]:.2f} ({measured['wall'][step]:.2f})" for step in STEPS)
    size = f"{objects:,} | {measured['prims']:,} | {measured['triples']:,} | {measured['floor']:.2f}"
    print(f"| {place} | {profile} | {size} | {steps} | {measured['peak']:.2f} | {measured['ratio']:.2f} |", flush=True)


def print_exponents(place: str, profile: str, sizes: list[int], runs: list[dict[str, Any]]) -> None:
    """Print the growth of each step with the number of objects."""
    slopes = " | ".join(f"{exponent(sizes, [run['cpu'][step] for run in runs]):.2f}" for step in STEPS)
    floor, memory = (exponent(sizes, [run[key] for run in runs]) for key in ("floor", "peak"))
    print(f"| {place} | {profile} | exponent | | | {floor:.2f} | {slopes} | {memory:.2f} | |", flush=True)


def compare(places: list[str], profiles: list[str], sizes: list[int]) -> None:
    """Write the stages, measure each with all profiles, and print a table."""
    steps = " | ".join(f"{step}, s" for step in STEPS)
    print(f"| place | profile | objects | prims | triples | floor, s | {steps} | peak GB | ours / its own |")
    print("|" + " --- |" * (8 + len(STEPS)))
    with tempfile.TemporaryDirectory() as folder:
        for place in places:
            stages = {size: Path(folder) / f"{place}_{size}.usdc" for size in sizes}
            for size, stage in stages.items():
                write_stage(stage, place, size)
            for profile in profiles:
                runs = []
                for size, stage in stages.items():
                    measured = run_child("--measure", str(stage), "--profiles", profile)
                    runs.append({**measured, "floor": run_child("--floor", str(stage))["seconds"]})
                    print_row(place, profile, size, runs[-1])
                if len(sizes) > 1:
                    print_exponents(place, profile, sizes, runs)


def write_stage(stage: Path, place: str, size: int) -> None:
    """Write a place with about `size` objects."""
    # Imported here, since they open OpenUSD, which the child processes measure.
    from benchmarks.reading.run import PRIMS_PER_OBJECT, make_stage  # noqa: PLC0415
    from benchmarks.scale.stage import write_place  # noqa: PLC0415

    if place == TWIN:
        make_stage(stage, PRIMS_PER_OBJECT * size, instanced=True)
    else:
        write_place(stage, place, size)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="Time the whole chain, from a file to a graph.")
    parser.add_argument("objects", nargs="*", type=int, default=[1_000, 10_000, 100_000])
    parser.add_argument("--places", nargs="+", choices=(*PLACES, TWIN), default=[*PLACES, TWIN])
    parser.add_argument("--profiles", nargs="+", choices=("soma", "plain"), default=["soma", "plain"])
    parser.add_argument("--measure", type=Path, help="Measure one stage and print figures as JSON.")
    parser.add_argument("--floor", type=Path, help="Open and traverse one stage and print figures as JSON.")
    arguments = parser.parse_args()
    if arguments.floor is not None:
        print(json.dumps(measure_floor(arguments.floor)))
    elif arguments.measure is not None:
        print(json.dumps(measure(arguments.measure, arguments.profiles[0])))
    else:
        compare(arguments.places, arguments.profiles, arguments.objects)


if __name__ == "__main__":
    main()
