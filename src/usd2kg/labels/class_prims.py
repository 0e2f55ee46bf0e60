"""Class prims, to which the semantic tags of Multiverse point."""

import re
from collections.abc import Iterator
from typing import Any

from pxr import Sdf, Tf

from usd2kg.labels.model import ClassLabel

__all__ = ["ClassPrims"]


class ClassPrims:
    """The class prims `/<ontology>/_class_<name>` of a layer; those on the stage are reused."""

    def __init__(self, stage: Any, layer: Any) -> None:
        self._stage = stage
        self._layer = layer
        self._scopes: dict[str, str] = {}
        """Namespace → path of the prim above its class prims."""
        self._paths: dict[str, str] = {}
        """IRI → path of the class prim."""
        self._new: dict[str, ClassLabel] = {}
        """Path → class of the prims to author."""

    def path_of(self, label: ClassLabel) -> str:
        """Return the path of the prim of a class."""
        if label.iri not in self._paths:
            name = re.sub(r"[^0-9A-Za-z_]", "", label.local_name) or label.local_name
            stem = f"{self._scope_of(label.namespace)}/_class_{_valid_identifier(name)}"
            path = next(path for path in _numbered(stem) if self._is_available(path, label))
            self._paths[label.iri] = path
            if not self._stage.GetPrimAtPath(path):
                self._new[path] = label
        return self._paths[label.iri]

    def _scope_of(self, namespace: str) -> str:
        if namespace not in self._scopes:
            name = re.split(r"[/:]", namespace.rstrip("#/:"))[-1]
            stem = "/" + _valid_identifier(re.sub(r"\.(owl|ttl|rdf|ofn)$", "", name) or "Ontology")
            taken = set(self._scopes.values())
            self._scopes[namespace] = next(
                path for path in _numbered(stem) if path not in taken and self._is_untyped(path)
            )
        return self._scopes[namespace]

    def _is_untyped(self, path: str) -> bool:
        prim = self._stage.GetPrimAtPath(path)
        return not prim or not prim.GetTypeName()

    def _is_available(self, path: str, label: ClassLabel) -> bool:
        """Return whether a path has no prim, or the prim of this class."""
        if path in self._new:
            return False
        prim = self._stage.GetPrimAtPath(path)
        if not prim:
            return True
        values = [prim.GetAttribute(name).Get() for name in ("rdf:namespace", "rdf:conceptName")]
        return values == [label.namespace, label.local_name]

    def author(self) -> None:
        """Author the class prims that are not on the stage."""
        for path, label in sorted(self._new.items()):
            spec = Sdf.CreatePrimInLayer(self._layer, path)
            parent = spec.nameParent
            parent.specifier, spec.specifier = Sdf.SpecifierDef, Sdf.SpecifierClass
            schemas = Sdf.TokenListOp()
            schemas.prependedItems = ["RdfAPI"]
            spec.SetInfo("apiSchemas", schemas)
            values = {"conceptName": label.local_name, "definition": label.definition, "namespace": label.namespace}
            for name, text in values.items():
                if text:
                    Sdf.AttributeSpec(spec, f"rdf:{name}", Sdf.ValueTypeNames.String).default = text


def _valid_identifier(name: str) -> str:
    return str(Tf.MakeValidIdentifier(name))


def _numbered(stem: str) -> Iterator[str]:
    """Yield stem, stem_2, stem_3…"""
    yield stem
    number = 2
    while True:
        yield f"{stem}_{number}"
        number += 1
