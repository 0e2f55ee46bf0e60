"""Try the wheel with several versions of Python, with the oldest and the newest dependencies that it allows.

Usage: python -m tools.try_wheel dist/usd2kg-*.whl [PYTHON…]

PYTHON is an interpreter, or a version that uv finds on this machine; default: 3.11, 3.12 and 3.13. Each environment
builds the graph of the demo kitchen and asks it a question; the graphs must have the same bytes. Prints a table; exit
code 1 if a trial failed.
"""

import email
import hashlib
import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import NamedTuple

PYTHONS = ("3.11", "3.12", "3.13")
RESOLUTIONS = {"oldest": "lowest-direct", "newest": "highest"}
SHOWN = ("usd-core", "numpy", "pyoxigraph", "py-horned-owl")


class Trial(NamedTuple):
    """What came of one environment."""

    python: str
    resolution: str
    versions: str
    digest: str
    """Start of the SHA-256 of the graph; empty if the trial failed."""
    problem: str


def run(*command: str | Path, folder: Path) -> str:
    """Return what a command prints.

    Raises:
        RuntimeError: it failed.
    """
    done = subprocess.run(
        [str(word) for word in command],
        cwd=folder,
        env={**os.environ, "VIRTUAL_ENV": str(folder / "venv")},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        lines = (done.stderr or done.stdout).strip().splitlines()
        raise RuntimeError(lines[-1] if lines else f"exit code {done.returncode}")
    return done.stdout


def required_by(wheel: Path) -> list[str]:
    """Return the dependencies of a wheel without those of its extras."""
    with zipfile.ZipFile(wheel) as archive:
        name = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        metadata = email.message_from_bytes(archive.read(name))
    return [entry for entry in metadata.get_all("Requires-Dist", []) if "extra ==" not in entry]


def try_wheel(wheel: Path, python: str, resolution: str) -> Trial:
    """Return what comes of the wheel with one Python and one choice of dependencies."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        versions, digest, problem = "", "", ""
        try:
            run("uv", "venv", "--quiet", "--python", python, "--no-python-downloads", "venv", folder=folder)
            wanted: list[str | Path] = [
                "--only-binary",
                ":all:",
                "--resolution",
                RESOLUTIONS[resolution],
                wheel,
                *required_by(wheel),
            ]
            run("uv", "pip", "install", "--quiet", *wanted, folder=folder)
            frozen = dict(
                line.split("==") for line in run("uv", "pip", "freeze", folder=folder).split() if "==" in line
            )
            versions = ", ".join(f"{package} {frozen[package]}" for package in SHOWN)
            command = folder / "venv/bin/usd2kg"
            run(command, "demo", "-o", "kitchen.ttl", folder=folder)
            answer = run(command, "query", "kitchen.ttl", "on", "dining", "table", folder=folder)
            if "dinnerPlate_1" not in answer:
                raise RuntimeError("the dining table carries no dinner plate")
            digest = hashlib.sha256((folder / "kitchen.ttl").read_bytes()).hexdigest()[:12]
        except RuntimeError as error:
            problem = str(error)
        return Trial(python, resolution, versions, digest, problem)


def main() -> None:
    """Try all combinations and print them."""
    wheel, *pythons = sys.argv[1:]
    trials = []
    for python in pythons or PYTHONS:
        for resolution in RESOLUTIONS:
            trial = try_wheel(Path(wheel).absolute(), python, resolution)
            print(
                f"{python:<5} {resolution:<7} {trial.digest or 'FAILED':<13} {trial.problem or trial.versions}",
                flush=True,
            )
            trials.append(trial)
    if len({trial.digest for trial in trials}) != 1 or any(trial.problem for trial in trials):
        raise SystemExit("the trials differ, or one failed")


if __name__ == "__main__":
    main()
