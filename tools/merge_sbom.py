"""Write the bill of materials of a release: dependencies, those of all extras, and what the pages bundle.

Usage: python -m tools.merge_sbom RUN EXTRAS LOCK OUTPUT

RUN and EXTRAS are CycloneDX files of the pinned dependencies without and with all extras, LOCK is the package-lock.json
of the pages. A component that only an extra needs has the scope `optional`, all others `required`. The output has no
time stamp and no serial number, so two runs give the same bytes.
"""

import base64
import json
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from urllib.parse import quote

__all__ = ["merge_sbom", "read_npm_components"]

_KEPT = ("type", "name", "version", "licenses", "purl", "externalReferences")
_BUNDLED = [{"name": "usd2kg:bundled-in", "value": "pages of usd2kg studio and usd2kg serve"}]
_NOT_SHIPPED = ("dev", "peer")


def merge_sbom(run: Mapping[str, Any], extras: Mapping[str, Any], lock: Mapping[str, Any]) -> dict[str, Any]:
    """Return one bill of materials, its components sorted by package URL.

    Args:
        run: CycloneDX of the dependencies without extras.
        extras: CycloneDX of the dependencies with all extras.
        lock: package-lock.json, version 2 or 3.
    """
    required = {component["purl"]: _python_component(component, "required") for component in run["components"]}
    optional = {component["purl"]: _python_component(component, "optional") for component in extras["components"]}
    bundled = {component["purl"]: component for component in read_npm_components(lock)}
    components = dict(sorted({**optional, **required, **bundled}.items()))
    root = run["metadata"]["component"]["bom-ref"]
    graph = [{"ref": root, "dependsOn": [*components]}, *({"ref": purl} for purl in components)]
    return {**run, "components": [*components.values()], "dependencies": graph}


def _python_component(component: Mapping[str, Any], scope: str) -> dict[str, Any]:
    kept = {key: component[key] for key in _KEPT if key in component}
    # Line numbers of a file of requirements, which differ between the two.
    return {**kept, "bom-ref": component["purl"], "scope": scope}


def read_npm_components(lock: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield a component for each package that a build of the pages bundles: those that are not for development."""
    for path, package in lock["packages"].items():
        name = path.rpartition("node_modules/")[2]
        if not name or any(package.get(key) for key in _NOT_SHIPPED):
            continue
        purl = f"pkg:npm/{quote(name, safe='/')}@{package['version']}"
        algorithm, _, digest = package["integrity"].partition("-")
        yield {
            "type": "library",
            "name": name,
            "version": package["version"],
            "purl": purl,
            "bom-ref": purl,
            "scope": "required",
            "hashes": [{"alg": algorithm.upper().replace("SHA", "SHA-"), "content": base64.b64decode(digest).hex()}],
            **({"licenses": [{"license": {"id": package["license"]}}]} if "license" in package else {}),
            "properties": _BUNDLED,
        }


def _main(run: str, extras: str, lock: str, output: str) -> None:
    read = [json.loads(Path(path).read_text("utf-8")) for path in (run, extras, lock)]
    Path(output).write_text(json.dumps(merge_sbom(*read), indent=2) + "\n", "utf-8")


if __name__ == "__main__":
    _main(*sys.argv[1:])
