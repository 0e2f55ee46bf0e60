"""Time the lexical grounder: loading, and objects per second.

Usage: python -m benchmarks.grounding.run [NAMES] (default 1500)

Names come from the lists of `benchmarks/names` or are composed of words of the home vocabulary. All are distinct; the
objects have random sizes, in rooms of forty. The first hundred names are timed separately because they load data
lazily. Each measurement is the minimum of three fresh interpreters on one core: processor time and peak memory. Each
is compared with a simple baseline of the same run.
"""

import os
import random
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from itertools import islice

from benchmarks.bare import bare_object, bare_scene
from benchmarks.names.lists import HOME_TABLE, read_names
from usd2kg.grounding import NamingRegime, ground
from usd2kg.grounding.context.views import abbreviate
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import Scene
from usd2kg.words import words_of

REPEATS = 3
ROOM = 40
LOAD = """
import resource, sys, time
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import load_home_tbox
from usd2kg.grounding import ObjectView

imported = time.process_time()
LexicalGrounder().ground_views([("/cup", ObjectView(name="coffee_mug"))], load_home_tbox())
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)
print(imported, time.process_time(), peak)
"""
BARE = """
import gzip, resource, sys, time
from importlib.resources import files
import numpy as np

data = files("usd2kg") / "data"
texts = [gzip.decompress((data / name).read_bytes()).decode() for name in ("wordnet.txt.gz", "frequencies.txt.gz")]
texts += [(data / name).read_text("utf-8") for name in ("home_names.csv", "head_noun.json", "calibration.json")]
with np.load(data / "name_classifier.npz") as arrays:
    weights = [arrays[name] for name in arrays.files]
texts.append((files("usd2kg") / "data" / "home.ttl").read_text("utf-8"))
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)
print(time.process_time(), peak)
"""
"""Baseline: import numpy and read the files that the first answer needs."""

FIRST = 100
"""Number of names after which all data is loaded."""


def written_names(write: Callable[[list[str]], str]) -> Iterator[str]:
    """Yield distinct names of two or three words of the home vocabulary, endlessly."""
    rng = random.Random(0)
    things = sorted(
        {name for names in home_names().values() for name in names if name.isascii() and name.count(" ") < 2}
    )
    words = sorted({word.lower() for thing in things for word in thing.split() if word.isalpha()})
    seen = set()
    while True:
        chosen = [rng.choice(words), *rng.choice(things).split()]
        name = write([word.capitalize() for word in chosen if word.isalnum()])
        if name not in seen:
            seen.add(name)
            yield name


def listed_names() -> Iterator[str]:
    """Yield the distinct names of all lists, shuffled."""
    names = {row["name"]: None for listed in read_names(HOME_TABLE) for row in listed.rows}
    yield from random.Random(2).sample(list(names), len(names))


SAMPLES: dict[str, tuple[Iterator[str], NamingRegime]] = {
    "as people write them": (listed_names(), NamingRegime.SEMANTIC),
    "plain": (written_names("".join), NamingRegime.SEMANTIC),
    "abbreviated by their author": (
        written_names(lambda words: "_".join(map(abbreviate, words))),
        NamingRegime.SEMANTIC,
    ),
    "abbreviated by the regime": (written_names("".join), NamingRegime.ABBREVIATED),
    "opaque": (written_names("".join), NamingRegime.OPAQUE),
}
"""Kind of names → names and naming regime."""


def make_scene(names: list[str]) -> Scene:
    """Return objects with these names and extents of 1 cm to 2 m, forty per room."""
    rng = random.Random(1)
    sizes = [(rng.uniform(0.01, 2), rng.uniform(0.01, 2), rng.uniform(0.01, 2)) for _ in names]
    paths = [f"/World/Room_{at // ROOM}/{name}" for at, name in enumerate(names)]
    # Rooms are apart and objects scattered, so that neighbours are looked up too.
    spots = [
        (10.0 * (at // ROOM) + rng.uniform(0, 6), rng.uniform(0, 6), rng.uniform(0, 2)) for at in range(len(names))
    ]
    return bare_scene("names put together", list(map(bare_object, paths, sizes, spots)))


def measure(kind: str, count: int) -> None:
    """Ground a hundred names, then `count`; print seconds for both, for plain look-ups, and peak megabytes."""
    names, regime = SAMPLES[kind]
    first, scene = (make_scene(list(islice(names, number))) for number in (FIRST, count))
    tbox = load_home_tbox()
    ground(make_scene(["CoffeeMug"]), tbox)
    start = time.process_time()
    ground(first, tbox, regime=regime)
    loaded = time.process_time()
    ground(scene, tbox, regime=regime)
    print(loaded - start, time.process_time() - loaded, time_look_ups(scene), peak_megabytes())


def time_look_ups(scene: Scene) -> float:
    """Return the minimum time to look up the words of each name in a table, longest suffix first."""
    table = {name.lower().replace(" ", ""): iri for iri, names in home_names().items() for name in names}
    took = []
    for _ in range(REPEATS):
        words_of.cache_clear()
        start = time.process_time()
        for obj in scene.objects:
            words = words_of(obj.name)
            runs = ("".join(words[at:]) for at in range(len(words)))
            next((table[run] for run in runs if run in table), None)
        took.append(time.process_time() - start)
    return min(took)


def peak_megabytes() -> float:
    """Return the peak memory of this process in megabytes; Linux reports kilobytes, macOS bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3)


def minimum_of_runs(*arguments: str) -> list[float]:
    """Return the minimum of each number printed by fresh interpreters on one core."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    printed = [
        subprocess.run([sys.executable, *arguments], check=True, capture_output=True, text=True, env=environment).stdout
        for _ in range(REPEATS)
    ]
    return [min(numbers) for numbers in zip(*(map(float, text.split()) for text in printed), strict=True)]


def main() -> None:
    """Measure and print."""
    count = sys.argv[1] if len(sys.argv) > 1 else "1500"
    bare, bare_megabytes = minimum_of_runs("-c", BARE)
    imported, answered, megabytes = minimum_of_runs("-c", LOAD)
    print(f"numpy and the same files:    {bare:.2f} s, {bare_megabytes:.0f} MB")
    print(f"import:                      {imported:.2f} s, {imported / bare:.1f} × baseline")
    print(f"import and first answer:     {answered:.2f} s, {answered / bare:.1f} × baseline, {megabytes:.0f} MB")
    print(f"{'names':<28} {'first 100':>9} {'then':>7} {'a second':>9} {'look-ups each':>14} {'peak MB':>8}")
    for kind in SAMPLES:
        first, seconds, look_ups, megabytes = minimum_of_runs("-m", "benchmarks.grounding.run", count, kind)
        rate, ratio = int(count) / seconds, seconds / look_ups
        print(f"{kind:<28} {first:>7.2f} s {count:>7} {rate:>9.0f} {ratio:>14.0f} {megabytes:>8.0f}")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        measure(sys.argv[2], int(sys.argv[1]))
    else:
        main()
