"""fetch_scenes: download labelled scenes with their hashes, and write a matrix of them."""

import hashlib
import json
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from usd2kg.download import download, shown_address
from usd2kg.errors import EvaluationError, OutputError
from usd2kg.evaluation.limits import FETCH
from usd2kg.evaluation.manifest import ManifestFile, ManifestScene
from usd2kg.files import hash_file, write_whole

__all__ = ["MATRIX", "fetch_scenes"]

MATRIX = "matrix.toml"
"""The matrix of the scenes, in their common folder."""


def fetch_scenes(
    scenes: Sequence[ManifestScene],
    folder: Path,
    *,
    overwrites: bool = False,
    report: Callable[[str], None] = lambda line: None,
) -> Path:
    """Download the files of scenes into a folder for each, and return the matrix of them, for `eval reproduce`.

    Files that exist with the right hash are not downloaded. A file is written only after it has been downloaded
    completely with the right hash, so an interrupted download leaves no partial file, and the same call resumes it.

    Args:
        scenes: the scenes to fetch.
        folder: destination, created if it does not exist.
        overwrites: replace existing files that differ.
        report: called with one line per file.

    Raises:
        EvaluationError: a file exists and differs, cannot be downloaded, or has another hash.
        OutputError: the folder cannot be written to.
    """
    matrix = (folder / MATRIX, _format_matrix(scenes).encode())
    targets = [(folder / scene.name / one.file, one) for scene in scenes for one in scene.files]
    existing = {path for path, one in targets if path.is_file() and hash_file(path) == one.sha256}
    if not overwrites:
        _check_unchanged([path for path, _ in targets if path not in existing], matrix)
    for scene in scenes:
        report(f"{scene.name}: {len(scene.files)} files, licence {scene.licence}")
    for path, one in targets:
        if path in existing:
            report(f"{path}: up to date")
            continue
        _make_folder(path.parent)
        write_whole(path, _verified(one))
        report(f"{path}: {path.stat().st_size:,} bytes from {shown_address(one.address)}, sha256 {one.sha256}")
    write_whole(*matrix)
    return matrix[0]


def _check_unchanged(missing: Sequence[Path], matrix: tuple[Path, bytes]) -> None:
    """Check that no existing file would be changed.

    Raises:
        EvaluationError: a file exists and differs.
    """
    path, text = matrix
    is_other_matrix = path.exists() and path.read_bytes() != text
    changed = next((file for file in missing if file.exists()), path if is_other_matrix else None)
    if changed is not None:
        raise EvaluationError(
            f"{changed}: exists and differs from the manifest; choose another folder with --into, or overwrite it with "
            "--force"
        )


def _verified(file: ManifestFile) -> Iterator[bytes]:
    """Yield the bytes of a file.

    Raises:
        EvaluationError: the file cannot be downloaded, or its hash is wrong; the latter is raised at the end.
    """
    digest = hashlib.sha256()
    for chunk in download(file.address, max_bytes=FETCH.file_bytes, timeout_s=FETCH.timeout_s, error=EvaluationError):
        digest.update(chunk)
        yield chunk
    if digest.hexdigest() != file.sha256:
        raise EvaluationError(
            f"{shown_address(file.address)}: sha256 is {digest.hexdigest()}, expected {file.sha256}; the file was "
            "not written, ask the publisher of the manifest"
        )


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be created ({error.strerror}); choose another folder") from error


def _format_matrix(scenes: Sequence[ManifestScene]) -> str:
    """Return a matrix of the scenes with the offline grounders; JSON strings are valid TOML strings."""
    lines = ['title = "Fetched scenes"']
    for scene in scenes:
        lines += ["", "[[scene]]", f"name = {_quote(scene.name)}"]
        lines += [f"path = {_quote(f'{scene.name}/{scene.stage}')}", f"gold = {_quote(f'{scene.name}/{scene.gold}')}"]
        if scene.ontology:
            lines.append(f"ontology = {_quote(f'{scene.name}/{scene.ontology}')}")
        note = f"{scene.note}; licence {scene.licence}" if scene.note else f"licence {scene.licence}"
        lines.append(f"note = {_quote(note)}")
    return "\n".join(lines) + "\n"


def _quote(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
