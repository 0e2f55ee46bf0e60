"""Read files in a child process, which may crash or hang."""

import ctypes
import faulthandler
import importlib
import itertools
import json
import os
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import traceback
import warnings
from contextlib import suppress
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import NamedTuple

from pxr import Sdf, Tf, Usd, UsdGeom

import usd2kg
from tests.scene.fuzz.corpus import Files
from tests.scene.fuzz.sanity import insane, insane_objects, is_line
from usd2kg.errors import SceneError
from usd2kg.scene import ReadOptions, read_scene
from usd2kg.scene.stage import captured_diagnostics

SECONDS = 10
"""Time limit of one case."""
READ_STAGE = "tests.scene.fuzz.worker:read_checked"
CHECK_CHAIN = "tests.scene.fuzz.chain:check_chain"
CHECK_INPUT = "tests.scene.fuzz.chain:check_input"
"""What a child process does with each file."""
_MEMORY = 4 * 2**30
_REPOSITORY = Path(__file__).parents[3]
_PACKAGE = str(Path(usd2kg.__file__).parent)
_READY = "ready\n"


class Outcome(StrEnum):
    """Outcome of a case."""

    READ = "read"
    REFUSED = "refused"
    EXCEPTION = "other exception"
    INSANE = "insane scene"
    TALKED = "wrote to the terminal"
    HUNG = "too slow"
    MEMORY = "out of memory"
    DIED = "died"
    OPENUSD_DIED = "OpenUSD died"
    OPENUSD_BUSY = "OpenUSD too slow or out of memory"
    OPENUSD_TALKED = "OpenUSD wrote to the terminal, past its diagnostics"


OPENUSDS = frozenset({Outcome.OPENUSD_DIED, Outcome.OPENUSD_BUSY, Outcome.OPENUSD_TALKED})
"""Outcomes that are faults of OpenUSD."""


class Verdict(NamedTuple):
    """Outcome of one case, with its place."""

    outcome: Outcome
    place: str = ""
    """Innermost line of usd2kg, or the violated invariant; equal for equal faults."""
    detail: str = ""


def read_checked(path: str) -> Verdict:
    """Return the verdict on `read_scene` for a file."""
    try:
        scene = read_scene(path)
        problem = next(insane(scene), None)
        if not problem and any(obj.instances for obj in scene.objects):
            copies = read_scene(path, options=ReadOptions(expand_instancers=True))
            problem = next((f"{problem} of a copy" for problem in insane_objects(copies)), None)
        return Verdict(Outcome.INSANE, problem) if problem else Verdict(Outcome.READ)
    except SceneError as error:
        message = str(error)
        if is_line(message) and message.startswith(f"{path}: "):
            return Verdict(Outcome.REFUSED, detail=message[:500])
        return Verdict(Outcome.INSANE, "message of several lines, or without the file", message[:500])
    except MemoryError:
        return Verdict(Outcome.MEMORY, detail=traceback.format_exc()[-1000:])
    except Exception as error:
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename.startswith(_PACKAGE)]
        place = f"{type(error).__name__} in {_place(frames[-1].filename, frames[-1].lineno, frames[-1].name)}"
        return Verdict(Outcome.EXCEPTION, place, traceback.format_exc()[-1000:])


def read_plainly(path: str) -> Verdict:
    """Return the verdict on OpenUSD alone: compose a file, read all values and compute its bounds."""
    try:
        with captured_diagnostics():
            stage = Usd.Stage.Open(path)
            for item in stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)):
                _read_all_values(item)
            for key in stage.GetRootLayer().pseudoRoot.ListInfoKeys():
                with suppress(Tf.ErrorException, UnicodeDecodeError):
                    stage.GetMetadata(key)
            for layer in stage.GetUsedLayers():
                layer.Traverse(Sdf.Path.absoluteRootPath, partial(_read_all_fields, layer))
            UsdGeom.BBoxCache(Usd.TimeCode.EarliestTime(), ["default"]).ComputeWorldBound(stage.GetPseudoRoot())
    except (Tf.ErrorException, UnicodeDecodeError):
        return Verdict(Outcome.REFUSED)
    except MemoryError:
        return Verdict(Outcome.MEMORY)
    return Verdict(Outcome.READ)


def _read_all_values(item):
    attributes = []
    questions = [item.GetAllAuthoredMetadata, item.GetAssetInfo]
    with suppress(Tf.ErrorException, UnicodeDecodeError):
        # Include schema attributes, since an authored property may not be an attribute.
        attributes = item.GetAttributes()
    for attribute in attributes:
        questions += [attribute.Get, partial(attribute.Get, Usd.TimeCode.EarliestTime())]
    for ask in questions:
        with suppress(Tf.ErrorException, UnicodeDecodeError):
            ask()


def _read_all_fields(layer, path):
    with suppress(Tf.ErrorException, UnicodeDecodeError):
        spec = layer.GetObjectAtPath(path)
        for key in spec.ListInfoKeys() if spec else ():
            with suppress(Tf.ErrorException, UnicodeDecodeError):
                spec.GetInfo(key)


def _place(file: str, line: int | None, function: str) -> str:
    return f"{Path(file).parent.name}/{Path(file).name}:{line} {function}"


def serve(examine: str, trace: str) -> None:
    """Answer each path on standard input with a verdict as one line of JSON, until the input ends.

    Args:
        examine: `module:function` that returns the verdict.
        trace: file for the Python traceback when the process is killed by a signal or times out.
    """
    module, _, name = examine.partition(":")
    judge = getattr(importlib.import_module(module), name)
    answers = os.fdopen(os.dup(1), "w")
    print(end=_READY, file=answers, flush=True)
    libc = ctypes.CDLL(None)
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    warnings.simplefilter("error")
    with tempfile.TemporaryFile() as said, Path(trace).open("w") as places:
        os.dup2(said.fileno(), 1)
        os.dup2(said.fileno(), 2)
        faulthandler.enable(places)
        for line in sys.stdin:
            seconds = SECONDS if examine == READ_STAGE else 6 * SECONDS
            faulthandler.dump_traceback_later(seconds - 1, file=places)
            verdict = judge(line.rstrip("\n"))
            faulthandler.cancel_dump_traceback_later()
            sys.stdout.flush()
            sys.stderr.flush()
            libc.fflush(None)
            if os.lseek(1, 0, os.SEEK_END) and verdict.outcome in {Outcome.READ, Outcome.REFUSED}:
                os.lseek(1, 0, os.SEEK_SET)
                text = os.read(1, 500).decode(errors="replace")
                # Numbers differ between cases.
                verdict = Verdict(Outcome.TALKED, re.split(r"[\d(\n]", text, maxsplit=1)[0][:60], text)
            os.ftruncate(1, 0)
            os.lseek(1, 0, os.SEEK_SET)
            print(json.dumps(verdict), file=answers, flush=True)


class Worker:
    """A child process that examines files one by one; it is replaced when it dies."""

    def __init__(self, examine: str, folder: Path) -> None:
        self.starts = 0
        self._examine = examine
        self._trace = folder / f"trace_{examine.partition(':')[2]}"
        self._process: subprocess.Popen[str] | None = None

    def ask(self, path: Path, seconds: float = SECONDS) -> Verdict:
        """Return the verdict on a file; `DIED` or `HUNG` if the process returned none."""
        process = self._process or self._start()
        print(path, file=process.stdin, flush=True)
        ready, _, _ = select.select([process.stdout], [], [], seconds)
        answer = process.stdout.readline() if ready else ""
        if answer:
            outcome, place, detail = json.loads(answer)
            return Verdict(Outcome(outcome), place, detail)
        self.close()
        place = self._last_place()
        if not ready:
            return Verdict(Outcome.HUNG, place)
        code = process.returncode
        return Verdict(Outcome.DIED, f"{signal.Signals(-code).name if code < 0 else f'exit {code}'} in {place}")

    def _start(self) -> subprocess.Popen[str]:
        self.starts += 1
        run = "import sys; from tests.scene.fuzz.worker import serve; serve(*sys.argv[1:])"
        self._process = subprocess.Popen(
            [sys.executable, "-c", run, self._examine, str(self._trace)],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=_REPOSITORY,
        )  # fmt: skip
        if self._process.stdout.readline() != _READY:
            raise RuntimeError(f"the worker for {self._examine} did not start")
        return self._process

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            with self._process as process:
                process.kill()
            self._process = None

    def _last_place(self) -> str:
        text = self._trace.read_text(errors="replace")
        # Innermost first.
        found = re.search(rf'File "({re.escape(_PACKAGE)}[^"]*)", line (\d+) in (\S+)', text)
        return _place(found[1], int(found[2]), found[3]) if found else "OpenUSD"


_ATTRIBUTED_TO_OPENUSD = {
    Outcome.HUNG: Outcome.OPENUSD_BUSY,
    Outcome.MEMORY: Outcome.OPENUSD_BUSY,
    Outcome.TALKED: Outcome.OPENUSD_TALKED,
}


class Judge:
    """Writes the files of cases into a folder and returns the verdicts on them."""

    def __init__(self, folder: Path, examine: str = READ_STAGE) -> None:
        self._folder = folder
        self._cases = itertools.count()
        # The whole chain loads more, once, and does more.
        self._seconds = SECONDS if examine == READ_STAGE else 6 * SECONDS
        self._is_stage = examine != CHECK_INPUT
        self.reader = Worker(examine, folder)
        self._plain = Worker("tests.scene.fuzz.worker:read_plainly", folder)

    def judge(self, files: Files) -> Verdict:
        """Return the verdict on a stage; faults that OpenUSD alone reproduces are attributed to OpenUSD."""
        # A new path each time, because OpenUSD caches layers by path.
        folder = self._folder / str(next(self._cases))
        write_files(files, folder)
        path = folder / next(iter(files))
        verdict = self.reader.ask(path, self._seconds)
        if not self._is_stage:
            shutil.rmtree(folder)
            return verdict
        if verdict.outcome == Outcome.DIED and verdict.place.startswith("SIG"):
            # Python code alone cannot end with a signal.
            verdict = verdict._replace(outcome=Outcome.OPENUSD_DIED)
        attributed = _ATTRIBUTED_TO_OPENUSD.get(verdict.outcome)
        if attributed and self._plain.ask(path).outcome not in {Outcome.READ, Outcome.REFUSED}:
            verdict = verdict._replace(outcome=attributed)
        shutil.rmtree(folder)
        return verdict

    def close(self) -> None:
        """End the child processes."""
        self.reader.close()
        self._plain.close()


def write_files(files: Files, folder: Path) -> None:
    """Write the files of a stage into a new folder."""
    folder.mkdir(parents=True)
    for name, data in files.items():
        (folder / name).write_bytes(data)
