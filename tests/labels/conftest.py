"""Fixtures and shorthands of the label tests."""

from collections.abc import Callable

import pytest
from pxr import Usd

from tests.scene.usda import METRES, component, cube
from usd2kg.labels import ClassLabel, LabelOptions, LabelReport, write_labels
from usd2kg.scene.label_reader import read_labels

EARLIEST = Usd.TimeCode.EarliestTime()
SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"
ENCODINGS = ("UsdSemantics", "Isaac", "Multiverse")
MUG = component("Mug", cube("g"))


def class_label(name="Cup", ancestors=(), qcodes=("Q81727",), names=(), namespace=SOMA) -> ClassLabel:
    return ClassLabel(name, namespace + name, name, namespace, ancestors, qcodes, f"A {name}.", frozenset(names))


def labels_at(stage, path) -> set[tuple[str, str, str]]:
    """Return (encoding, taxonomy, value) of the labels of a prim."""
    labels = read_labels(stage.GetPrimAtPath(path), EARLIEST)
    return {(label.encoding, label.taxonomy, label.value) for label in labels}


def outcomes(report: LabelReport) -> dict[str, str]:
    return {entry.prim_path: entry.outcome for entry in report.outcomes}


@pytest.fixture
def write(write_stage, tmp_path) -> Callable[..., tuple[LabelReport, Usd.Stage]]:
    """A function that writes prims as a stage, labels it, and returns the report and the labelled stage."""

    def run(text, labels, name="labels.usda", layer=METRES, **options):
        source = write_stage(layer + text)
        before = source.read_bytes()
        report = write_labels(source, labels, tmp_path / name, LabelOptions(**options))
        assert source.read_bytes() == before, "the source is not modified"
        return report, Usd.Stage.Open(str(tmp_path / name))

    return run
