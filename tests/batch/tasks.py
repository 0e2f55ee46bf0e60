"""Tasks for workers, which import this module."""

import os
import signal
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usd2kg.batch import Job
from usd2kg.errors import SceneError


@dataclass(frozen=True)
class Acting:
    """Does what the name of a job says, and counts the attempts in a folder."""

    folder: Path

    def prepare(self) -> Callable[[Job], Mapping[str, Any]]:
        (self.folder / f"prepared-{os.getpid()}").touch()
        return self._act

    def _act(self, job: Job) -> Mapping[str, Any]:
        with (self.folder / f"attempts-{job.name}").open("a") as file:
            file.write("x")
        attempts = (self.folder / f"attempts-{job.name}").stat().st_size
        match job.name.partition("-")[0]:
            case "die":
                os.kill(os.getpid(), signal.SIGKILL)
            case "diesonce" if attempts == 1:
                os._exit(7)
            case "hang":
                time.sleep(600)
            case "grow":
                # Written pages, so that they are resident.
                held = [os.urandom(1 << 20) for _ in range(1000)]
                time.sleep(600)
                assert held
            case "broken":
                raise SceneError(f"{job.source}: is broken\nover two lines")
            case "bug":
                raise ZeroDivisionError("division by zero")
            case "deep":
                raise RecursionError
        job.target.write_text(job.name)
        return {"process": os.getpid(), "objects": 1}


@dataclass(frozen=True)
class Unprepared:
    """A task whose workers die at the start."""

    def prepare(self) -> Callable[[Job], Mapping[str, Any]]:
        os._exit(3)
