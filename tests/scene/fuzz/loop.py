"""Mutate and read stages, and count the outcomes."""

import itertools
import math
import random
import re
import shutil
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from tests.scene.fuzz.corpus import Files, as_crate, own_corpus, shared_corpus, text_of
from tests.scene.fuzz.mutators import mangle_bytes, mangle_text, multiply
from tests.scene.fuzz.worker import OPENUSDS, READ_STAGE, Judge, Outcome, Verdict, write_files

_KEPT = 3
"""Cases kept per failure."""


class Case(NamedTuple):
    """One mutated stage."""

    name: str
    """Seed, number and original stage; the same name means the same files."""
    files: Files


@dataclass
class Tally:
    """The outcomes of all cases."""

    outcomes: Counter[str] = field(default_factory=Counter)
    found: dict[Verdict, list[Case]] = field(default_factory=dict)
    """Faults of OpenUSD or usd2kg, by place, with their first cases."""

    def add(self, case: Case, verdict: Verdict) -> None:
        """Count a case."""
        self.outcomes[verdict.outcome] += 1
        if verdict.outcome in {Outcome.READ, Outcome.REFUSED}:
            return
        same = next((known for known in self.found if known[:2] == verdict[:2]), verdict)
        cases = self.found.setdefault(same, [])
        if len(cases) < _KEPT:
            cases.append(case)

    @property
    def failures(self) -> list[str]:
        """The faults of usd2kg, with the first case of each."""
        return [
            f"{verdict.outcome}: {verdict.place} ({cases[0].name}) {verdict.detail}"
            for verdict, cases in self.found.items()
            if verdict.outcome not in OPENUSDS
        ]

    def __str__(self) -> str:
        lines = [f"{count:7} {outcome}" for outcome, count in self.outcomes.most_common()]
        lines += [f"{verdict.outcome}: {verdict.place} ({cases[0].name})" for verdict, cases in self.found.items()]
        return "\n".join(lines)

    def keep(self, folder: Path) -> None:
        """Write the files of all faults, each with a description."""
        for verdict, cases in self.found.items():
            for case in cases:
                below = folder / re.sub(r"\W+", "_", f"{verdict.outcome} {verdict.place} {case.name}")
                shutil.rmtree(below, ignore_errors=True)
                write_files(case.files, below)
                (below / "verdict.txt").write_text("\n".join(verdict), encoding="utf-8", errors="replace")


def make_cases(corpus: dict[str, Files], seed: int) -> Iterator[Case]:
    """Yield an endless sequence of mutated stages; every fourth is a crate if there are any."""
    with tempfile.TemporaryDirectory() as folder:
        crates = [(name, crate) for name, files in corpus.items() if (crate := as_crate(files, Path(folder)))]
    texts = [text for files in corpus.values() if (text := text_of(next(iter(files.values()))))]
    for number in itertools.count():
        # A string seed gives reproducible sequences that differ between neighbouring seeds.
        rng = random.Random(f"{seed} {number}")
        name, files = rng.choice(crates if crates and number % 4 == 3 else list(corpus.items()))
        # Mutate the root layer in most cases; rebuild the dict so that it stays first.
        chosen = next(iter(files)) if rng.random() < 0.85 else rng.choice(list(files))
        yield Case(f"{seed} {number} {name}", {**files, chosen: _mangle(files[chosen], rng, texts)})


def scaled_cases(seed: int) -> Iterator[Case]:
    """Yield mutated stages, half of them with something multiplied: instances, objects in one place, or levels."""
    for number, case in enumerate(all_cases(seed)):
        rng = random.Random(f"{seed} scale {number}")
        root, data = next(iter(case.files.items()))
        text = text_of(data)
        is_scaled = bool(text) and rng.random() < 0.5
        yield case._replace(files={**case.files, root: multiply(text, rng).encode()}) if is_scaled else case


def all_cases(seed: int) -> Iterator[Case]:
    """Yield mutated stages of the own corpus, alternating with third-party files if there are any."""
    streams = [make_cases(corpus, seed) for corpus in (own_corpus(), shared_corpus()) if corpus]
    return itertools.chain.from_iterable(zip(*streams, strict=True))


def _mangle(data: bytes, rng: random.Random, texts: list[str]) -> bytes:
    text = text_of(data)
    # An unpaired surrogate makes a file that is not UTF-8.
    return mangle_text(text, rng, texts).encode(errors="surrogatepass") if text else mangle_bytes(data, rng)


def fuzz(cases: Iterable[Case], seconds: float = math.inf, examine: str = READ_STAGE) -> Tally:
    """Return the outcomes of the cases that start within `seconds`."""
    tally = Tally()
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(Path(folder), examine)
        try:
            for case in itertools.takewhile(lambda _: time.monotonic() < end, cases):
                tally.add(case, judge.judge(case.files))
        finally:
            judge.close()
    return tally
