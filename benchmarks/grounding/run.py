"""Time the embedded grounder: how long it takes to load, and how many names a second it grounds.

Usage: python benchmarks/grounding/run.py [NAMES] (default 10000)

Names are put together from the words of the product's own vocabulary, all different, on things of random size in rooms
of forty. Each measurement runs in a fresh interpreter on one core; times are of the processor, memory is the peak.
"""

import os
import random
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from itertools import islice

from usd2kg.grounding import ground
from usd2kg.grounding.embedded.lexicon import home_names
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import Box, NamingRegime, Scene, SceneObject, StageFrame, abbreviate

LOADS = 5
ROOM = 40
LOAD = """
import time
from usd2kg.grounding.embedded.grounder import EmbeddedGrounder
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import ObjectView

EmbeddedGrounder().ground_views([("/cup", ObjectView(name="coffee_mug"))], load_home_tbox())
print(time.process_time())
"""
SAMPLES: dict[str, tuple[Callable[[list[str]], str], NamingRegime]] = {
    "plain": ("".join, NamingRegime.SEMANTIC),
    "abbreviated by their author": (lambda words: "_".join(map(abbreviate, words)), NamingRegime.SEMANTIC),
    "abbreviated by the regime": ("".join, NamingRegime.ABBREVIATED),
    "opaque": ("".join, NamingRegime.OPAQUE),
}
"""Kind of names → how the scene writes the words of one, and the naming regime."""


def written_names(write: Callable[[list[str]], str]) -> Iterator[str]:
    """Yield different names of two or three words of the vocabulary, without end."""
    rng = random.Random(0)
    things = sorted(
        {name for names in home_names().values() for name in names if name.isascii() and name.count(" ") < 2}
    )
    words = sorted({word.lower() for thing in things for word in thing.split() if word.isalpha()})
    seen = set()
    while True:
        said = [rng.choice(words), *rng.choice(things).split()]
        name = write([word.capitalize() for word in said if word.isalnum()])
        if name not in seen:
            seen.add(name)
            yield name


def make_scene(names: list[str]) -> Scene:
    """Return things with these names, forty to a room, of random size."""
    rng = random.Random(1)
    return Scene(
        source="names put together",
        content_hash="",
        frame=StageFrame("Z", 1.0, 1.0, is_authored=True),
        time=None,
        prim_count=len(names),
        objects=tuple(make_object(f"/World/Room_{at // ROOM}/{name}", rng) for at, name in enumerate(names)),
        left_out={},
    )


def make_object(path: str, rng: random.Random) -> SceneObject:
    """Return a thing of 1 cm to 2 m, without any evidence but its name, size and place."""
    box = Box((0.0, 0.0, 0.0), (rng.uniform(0.01, 2), rng.uniform(0.01, 2), rng.uniform(0.01, 2)))
    return SceneObject(
        prim_path=path,
        name=path.rpartition("/")[2],
        type_name="Xform",
        kind="component",
        selected_by="listed",
        parent_path=None,
        box=box,
        own_box=box,
        part_boxes=(),
        position=(0.0, 0.0, 0.0),
        orientation=(0.0, 0.0, 0.0, 1.0),
        mass_kg=None,
        display_name="",
        documentation="",
        asset=(),
        materials=(),
        parts=(),
        display_color=None,
        instance_of=None,
    )


def measure(kind: str, count: int) -> None:
    """Ground that many names and print seconds, megabytes before and at the peak."""
    write, regime = SAMPLES[kind]
    scene, tbox = make_scene(list(islice(written_names(write), count))), load_home_tbox()
    ground(make_scene(["CoffeeMug"]), tbox)
    start = time.process_time()
    ground(scene, tbox, regime=regime)
    print(time.process_time() - start, peak_megabytes())


def peak_megabytes() -> float:
    """Return the largest memory that this process had, in megabytes; Linux counts kilobytes, macOS bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)


def output_of(*arguments: str) -> list[float]:
    """Return the numbers that a fresh interpreter prints, given one core."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, *arguments], check=True, capture_output=True, text=True, env=environment)
    return [float(number) for number in done.stdout.split()]


def main() -> None:
    """Measure and print."""
    count = sys.argv[1] if len(sys.argv) > 1 else "10000"
    loads = [output_of("-c", LOAD)[0] for _ in range(LOADS)]
    print(f"load: {statistics.median(loads):.2f} s (median of {LOADS}, the interpreter's start included)")
    print(f"{'names':<28} {'number':>7} {'a second':>9} {'peak MB':>8}")
    for kind in SAMPLES:
        seconds, megabytes = output_of(__file__, count, kind)
        print(f"{kind:<28} {count:>7} {int(count) / seconds:>9.0f} {megabytes:>8.0f}")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        measure(sys.argv[2], int(sys.argv[1]))
    else:
        main()
