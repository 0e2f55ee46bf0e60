"""Convert a file by an external program that writes USD, for converters that bundle their own OpenUSD.

The URDF and MJCF converters depend on `usd-exchange`, which installs a package `pxr` over that of `usd-core`; in one
environment, the converters fail to start. As programs in an environment of their own they work.
"""

import os
import re
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from pxr import Sdf, Tf, Usd

from usd2kg.convert.converted import Converted, parse_error
from usd2kg.errors import SceneError

__all__ = ["run_converter"]

_WARNING = re.compile(r"^\[Warning\] \[(?P<place>[^\]]*)\] (?P<text>.+)", re.MULTILINE)
_ERROR_PLACE = re.compile(r"^\s*Error in '[^']*' at line \d+ in file .+? : '?(?:Python runtime error: )?")
_OWN_ADVICE = "usdex.core.deprecation"
"""Source location of warnings intended for the developers of the converter."""
_MAX_NOTES = 20
"""Distinct warnings that are passed on; a file with missing meshes has one for each."""
_MAX_SECONDS = 600
"""Time limit of a program; robots with hundreds of meshes take seconds."""


def run_converter(
    program: str, path: Path, expected: str, arguments: Sequence[str] = (), *, corrected: bytes | None = None
) -> Converted:
    """Return the stage that `program` creates from a file. Textures are omitted.

    Args:
        program: name of the program on the path, also its package with dashes for underscores.
        path: the file.
        expected: what the file should be, for the message of an error.
        arguments: further arguments of the program.
        corrected: what the program reads instead of the content of the file, with absolute paths of other files.

    Raises:
        SceneError: the program is not installed, refuses the file, or does not end in ten minutes.
    """
    command = shutil.which(program)
    package = program.replace("_", "-")
    if command is None:
        raise SceneError(
            f"{path}: needs the program {program}, which is not on the path; run: pipx install {package} "
            "(in the environment of usd2kg, its OpenUSD would replace that of usd2kg)"
        )
    # Modules of this environment must not shadow those of the program.
    environment = {name: value for name, value in os.environ.items() if name not in {"PYTHONPATH", "PYTHONHOME"}}
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as corrections:
        source = path.resolve()
        if corrected is not None:
            source = Path(corrections, path.name)
            source.write_bytes(corrected)
        try:
            done = subprocess.run(
                [command, "--no-layer-structure", *arguments, str(source), folder],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                errors="replace",
                check=False,
                timeout=_MAX_SECONDS,
            )
        except subprocess.TimeoutExpired as error:
            raise SceneError(
                f"{path}: {program} did not end in {_MAX_SECONDS} s and was stopped; run it by itself: "
                f"{program} {path} FOLDER, and read the USD file that it writes"
            ) from error
        output = done.stdout.replace(str(source), str(path))
        written = sorted(Path(folder).glob("*.usd*"))
        if done.returncode != 0 or not written:
            raise parse_error(path, _reason(output) or f"{program} ended with code {done.returncode}", expected)
        layer = _load(written[0], path)
    stage = Usd.Stage.Open(layer)
    notes = [*_distinct_notes(output), *_remove_textures(stage)]
    return Converted(stage, str(layer.customLayerData.get("creator") or package), tuple(notes))


def _load(written: Path, path: Path) -> Any:
    try:
        layer = Sdf.Layer.OpenAsAnonymous(str(written))
    except Tf.ErrorException as error:
        raise SceneError(
            f"{path}: its converter wrote a layer that OpenUSD cannot read, expected one of a version up to "
            f"{'.'.join(map(str, Usd.GetVersion()[1:]))}; update usd2kg and usd-core"
        ) from error
    # Skip the line: it names the temporary folder.
    layer.documentation = ""
    return layer


def _reason(output: str) -> str:
    failures = [text.removeprefix("Conversion failed:").strip() for _, text in _warnings(output)]
    if failures and failures[-1]:
        return failures[-1]
    # An error of usd-exchange is on the line below, after its place in the program.
    lines = [line for line in output.splitlines() if line.strip()]
    return _ERROR_PLACE.sub("", lines[-1]).strip(" '\t") if lines else ""


def _warnings(output: str) -> Iterator[tuple[str, str]]:
    for found in _WARNING.finditer(output):
        yield found["place"], found["text"].strip()


def _distinct_notes(output: str) -> list[str]:
    notes = list(dict.fromkeys(text for place, text in _warnings(output) if place != _OWN_ADVICE))
    more = len(notes) - _MAX_NOTES
    return [*notes[:_MAX_NOTES], f"the converter has {more} more warnings"] if more > 0 else notes


def _remove_textures(stage: Usd.Stage) -> list[str]:
    """Remove the files of textures, which are in the temporary folder, and return a note if there are any."""
    files = [
        prim.GetPath().AppendProperty("inputs:file")
        for prim in stage.TraverseAll()
        if isinstance(prim.GetAttribute("inputs:file").Get(), Sdf.AssetPath)
    ]
    for path in files:
        stage.GetPrimAtPath(path.GetPrimPath()).RemoveProperty(path.name)
    return [f"textures are left out ({len(files)})"] if files else []
