"""usd2kg doctor: the installation and its configuration, for a bug report or a first check."""

import os
import platform
import re
import shutil
from collections.abc import Iterator, Mapping
from importlib.metadata import PackageNotFoundError, metadata, requires, version
from pathlib import Path
from typing import Any, NamedTuple

import typer

from usd2kg.cli.options.common import JsonOutput
from usd2kg.cli.output import emit, print_json
from usd2kg.cli.text_table import format_table
from usd2kg.version import VERSION

__all__ = ["doctor_command"]

_REQUIREMENT = re.compile(r"(?P<name>[\w.-]+)[^;]*(?:;.*extra == ['\"](?P<extra>\w+)['\"])?")
"""A requirement of a package's metadata: its name, and the extra in its marker."""
_BYTES_PER_MIB = 1 << 20
_PROGRAMS = ("java", "swipl", "urdf_usd_converter", "mujoco_usd_converter")
"""Programs that usd2kg runs if they are installed."""


class _Package(NamedTuple):
    """A package that usd2kg uses."""

    name: str
    extra: str
    """The extra that installs the package; empty for required packages."""
    version: str | None
    """None if the package is not installed."""


def doctor_command(json: JsonOutput = False) -> None:
    """List versions, extras, caches and credentials; keys are never shown."""
    packages = list(_packages())
    report: dict[str, Any] = {
        "usd2kg": VERSION,
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "platform": platform.platform(),
        "packages": {one.name: one.version for one in packages if not one.extra},
        "extras": _extras(packages),
        "page_of_the_studio": _has_page(),
        "programs": {name: shutil.which(name) for name in _PROGRAMS},
        "caches": dict(_caches()),
        "credentials": _credentials(os.environ),
    }
    if json:
        print_json(report)
    else:
        emit(_as_text(report))
    if any(found is None for found in report["packages"].values()):
        raise typer.Exit(1)


def _packages() -> Iterator[_Package]:
    for requirement in requires("usd2kg") or ():
        found = _REQUIREMENT.match(requirement)
        assert found is not None, "pip has parsed the requirement"
        yield _Package(found["name"], found["extra"] or "", _version(found["name"]))


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _extras(packages: list[_Package]) -> dict[str, dict[str, Any]]:
    """Return extra → whether it is installed, its packages, and the command that installs it."""
    extras = {}
    for extra in metadata("usd2kg").get_all("Provides-Extra") or ():
        found = {one.name: one.version for one in packages if one.extra == extra}
        is_complete = None not in found.values()
        install = "" if is_complete else f"pip install 'usd2kg[{extra}]'"
        extras[extra] = {"is_installed": is_complete, "packages": found, "install": install}
    return extras


def _has_page() -> bool:
    from usd2kg.endpoint.app_files import read_app_files  # noqa: PLC0415
    from usd2kg.errors import Usd2kgError  # noqa: PLC0415

    try:
        return bool(read_app_files("index.html"))
    except Usd2kgError:
        return False


def _caches() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield each cache with its path and size; the path is None if the cache is off, or there is no home folder."""
    from usd2kg.cache_folder import chosen_cache_folder  # noqa: PLC0415
    from usd2kg.errors import GroundingError  # noqa: PLC0415
    from usd2kg.grounding.llm.cache import default_cache_path  # noqa: PLC0415
    from usd2kg.query.graph_cache import GRAPH_CACHE_VARIABLE  # noqa: PLC0415
    from usd2kg.table_cache import TABLE_CACHE_VARIABLE  # noqa: PLC0415

    try:
        completions = default_cache_path()
    except GroundingError:
        completions = None
    paths = {
        "completions": completions,
        "graphs": chosen_cache_folder(GRAPH_CACHE_VARIABLE, "graphs"),
        "tables": chosen_cache_folder(TABLE_CACHE_VARIABLE, "tables"),
    }
    for name, path in paths.items():
        yield name, {"path": None if path is None else str(path), "mib": round(_size(path) / _BYTES_PER_MIB, 1)}


def _size(path: Path | None) -> int:
    if path is None:
        return 0
    files = [path] if path.is_file() else path.rglob("*")
    return sum(file.stat().st_size for file in files if file.is_file())


def _credentials(environment: Mapping[str, str]) -> dict[str, bool]:
    """Return environment variable → whether it is set."""
    from usd2kg.grounding.llm.model_reference import SECRET_VARIABLES  # noqa: PLC0415
    from usd2kg.stores.server_addresses import CREDENTIAL_VARIABLES  # noqa: PLC0415
    from usd2kg.studio.settings import PASSWORD_VARIABLE  # noqa: PLC0415

    names = [*SECRET_VARIABLES, *CREDENTIAL_VARIABLES, PASSWORD_VARIABLE]
    return {name: bool(environment.get(name, "").strip()) for name in names}


def _as_text(report: Mapping[str, Any]) -> str:
    rows = [
        ("usd2kg", report["usd2kg"], f"{report['python']}, {report['platform']}"),
        *((name, found or "missing", "") for name, found in report["packages"].items()),
    ]
    for extra, state in report["extras"].items():
        packages = ", ".join(f"{name} {found or 'missing'}" for name, found in state["packages"].items())
        rows.append((f"[{extra}]", "installed" if state["is_installed"] else state["install"], packages))
    rows.append(("studio's page", "built" if report["page_of_the_studio"] else "missing; run make web", ""))
    rows.extend((name, path or "not on the path", "program") for name, path in report["programs"].items())
    caches = report["caches"].items()
    rows.extend((f"cache of {name}", found["path"] or "off", f"{found['mib']} MiB") for name, found in caches)
    rows.extend((name, "set" if is_set else "not set", "") for name, is_set in report["credentials"].items())
    return format_table(("what", "state", "details"), rows)
