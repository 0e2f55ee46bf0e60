"""RDF properties of spatial relations."""

import pytest

from usd2kg.graph.relation_patterns import relation_annotations
from usd2kg.graph.vocabulary import U2K
from usd2kg.relations import Relation


@pytest.mark.parametrize(
    ("measured", "written"),
    [(0.0005000148, "0.0005"), (0.33 / 1.8, "0.183333"), (-7.450581e-10, "0"), (-0.0123456789, "-0.012346")],
)
def test_measurements_have_six_decimals(measured: float, written: str):
    relation = Relation("on", "/Cup", "/Table", "on/1", {"gap": measured})
    literals = [value.value for name, value in relation_annotations(relation) if name == U2K.gap]
    assert literals == [written]
