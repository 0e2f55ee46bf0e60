"""VolumeGrounder: results calculated by hand, and invalid tables of sizes."""

import math
from pathlib import Path

import pytest

from tests.grounding.records import LAB, SOMA, local, make_class, make_tbox
from usd2kg.errors import GroundingError
from usd2kg.grounding import Candidate, ObjectView, Prediction, Status
from usd2kg.grounding.baselines.volume import VolumeGrounder
from usd2kg.knowledge import read_rows
from usd2kg.ontology import TBox

HEADER = "class,width_m,depth_m,height_m,origin\n"
PAIR = make_tbox(make_class("Cup"), make_class("Crate"))


def ask(grounder: VolumeGrounder, size: tuple[float, float, float] | None, tbox: TBox = PAIR) -> Prediction:
    (prediction,) = grounder.ground_views([("/Room/thing", ObjectView(size=size))], tbox)
    return prediction


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def read_built_in() -> list[dict[str, str]]:
    return read_rows("class_sizes.csv")


def test_equals_a_result_calculated_by_hand():
    # 0.08 × 0.08 × 0.09 = 0.000576 m³; 0.0005 / 0.000576 = 0.868…
    prediction = ask(VolumeGrounder({"Cup": 0.0005, "Crate": 0.05}), (0.08, 0.08, 0.09))
    assert prediction.prim_path == "/Room/thing"
    assert prediction.class_iri == LAB + "Cup"
    assert prediction.confidence == pytest.approx(0.868056, abs=1e-6)
    assert prediction.confidence == pytest.approx(math.exp(-abs(math.log(0.000576) - math.log(0.0005))))
    assert (prediction.status, prediction.grounder, prediction.evidence) == (Status.GROUNDED, "volume", ("geometry",))
    assert prediction.explanation == "its box holds 0.58 l, nearest is Cup with 0.50 l"
    assert [c.class_iri for c in prediction.candidates] == [LAB + "Cup", LAB + "Crate"]
    assert [c.score for c in prediction.candidates] == pytest.approx([0.868056, 0.01152])


@pytest.mark.parametrize(
    ("volume", "nearest"),
    [
        # The midpoint of 0.001 and 0.1 is 0.01 in log volume, but 0.0505 in volume.
        (0.0099, "Cup"),
        (0.0101, "Crate"),
        (0.04, "Crate"),
        (1e-9, "Cup"),
        (1e6, "Crate"),
    ],
)
def test_compares_log_volumes(volume: float, nearest: str):
    grounder = VolumeGrounder({"Cup": 0.001, "Crate": 0.1})
    side = volume ** (1 / 3)
    assert local(ask(grounder, (side, side, side))) == nearest


def test_breaks_ties_by_iri():
    grounder = VolumeGrounder({"Cup": 0.25, "Crate": 4.0})
    prediction = ask(grounder, (1.0, 1.0, 1.0))
    assert prediction.candidates == (Candidate(LAB + "Crate", 0.25), Candidate(LAB + "Cup", 0.25))
    assert local(prediction) == "Crate"


def test_equal_volumes_have_confidence_1():
    assert ask(VolumeGrounder({"Cup": 0.125}), (0.5, 0.5, 0.5)).confidence == 1.0


@pytest.mark.parametrize("size", [(0.5, 0.5, 0.0), (0.5, 0.5, 0.0002), (0.0, 0.5, 0.5)])
def test_a_flat_box_counts_as_1_mm_thick(size: tuple[float, float, float]):
    prediction = ask(VolumeGrounder({"Cup": 0.00025, "Crate": 0.05}), size)
    assert (local(prediction), prediction.confidence) == ("Cup", pytest.approx(1.0))
    assert prediction.explanation == "its box holds 0.25 l, nearest is Cup with 0.25 l"


def test_a_point_counts_as_a_cubic_millimetre():
    prediction = ask(VolumeGrounder({"Cup": 0.0005}), (0.0, 0.0, 0.0))
    assert prediction.confidence == pytest.approx(2e-6)
    assert prediction.explanation == "its box holds 1.00 mm³, nearest is Cup with 0.50 l"


@pytest.mark.parametrize(
    ("volume", "said"),
    [
        (45.0, "45 m³"),
        (1.5, "1.50 m³"),
        (0.1, "0.10 m³"),
        (0.0999, "100 l"),
        (0.012, "12 l"),
        (0.0005, "0.50 l"),
        (0.00006, "60 ml"),
        (0.000002, "2.00 ml"),
        (5e-9, "5.00 mm³"),
    ],
)
def test_explanations_use_readable_units(volume: float, said: str):
    prediction = ask(VolumeGrounder({"Cup": volume}), (1.0, 1.0, 1.0))
    assert prediction.explanation == f"its box holds 1.00 m³, nearest is Cup with {said}"


@pytest.mark.parametrize("size", [None, (math.nan, 1.0, 1.0), (1.0, math.inf, 1.0), (1e200, 1e200, 1.0)])
def test_refuses_an_object_without_a_finite_box(size: tuple[float, float, float] | None):
    prediction = ask(VolumeGrounder({"Cup": 0.0005}), size)
    assert (prediction.status, prediction.class_iri, prediction.confidence) == (Status.REFUSED, None, None)
    assert prediction.explanation == "it has no box to measure"


def test_ignores_the_name(home_tbox: TBox):
    views = [("/a", ObjectView(name="Refrigerator", size=(0.09, 0.07, 0.08))), ("/b", ObjectView(size=None))]
    first, second = VolumeGrounder().ground_views(views, home_tbox)
    assert (local(first), second.status) == ("Cup", Status.REFUSED)


def test_predictions_are_independent_of_other_views(home_tbox: TBox):
    sizes = [(0.1, 0.1, 0.1), (1.0, 1.0, 1.0), None, (0.0, 0.2, 0.2), (0.1, 0.1, 0.1)]
    views = [(f"/thing{i}", ObjectView(size=size)) for i, size in enumerate(sizes)]
    together = VolumeGrounder().ground_views(views, home_tbox)
    assert together == [VolumeGrounder().ground_views([view], home_tbox)[0] for view in views]
    assert together[::-1] == VolumeGrounder().ground_views(views[::-1], home_tbox)
    assert VolumeGrounder().ground_views([], home_tbox) == []


def test_keeps_eight_candidates_best_first(home_tbox: TBox):
    scores = [candidate.score for candidate in ask(VolumeGrounder(), (0.3, 0.3, 0.3), home_tbox).candidates]
    assert len(scores) == 8
    assert scores == sorted(scores, reverse=True)


def test_only_classes_with_a_size_and_in_the_tbox_are_considered():
    tbox = make_tbox(make_class("Cup"), make_class("Thing"))
    prediction = ask(VolumeGrounder({"Cup": 0.0005, "Submarine": 1.0}), (1.0, 1.0, 1.0), tbox)
    assert [candidate.class_iri for candidate in prediction.candidates] == [LAB + "Cup"]


def test_reports_a_tbox_without_typical_sizes():
    with pytest.raises(GroundingError) as caught:
        ask(VolumeGrounder(), (1.0, 1.0, 1.0), make_tbox(make_class("Submarine"), make_class("Torpedo")))
    assert str(caught.value) == (
        "built-in: has a size for none of the 2 classes of written by hand; give typical sizes of these classes "
        "in a CSV file with the columns class,width_m,depth_m,height_m,origin"
    )


def test_rejects_two_sizes_of_one_class():
    grounder = VolumeGrounder({"Cup": 0.0005, LAB + "Cup": 0.0006}, "mine")
    with pytest.raises(GroundingError, match=r"^mine: https://lab.example/onto#Cup has the volumes 0.0005 and 0.0006"):
        ask(grounder, (1.0, 1.0, 1.0))
    assert local(ask(VolumeGrounder({"Cup": 0.5, LAB + "Cup": 0.5}), (1.0, 1.0, 1.0))) == "Cup"


@pytest.mark.parametrize("volume", [0.0, -1.0, math.nan, math.inf])
def test_rejects_volumes_that_are_not_positive_and_finite(volume: float):
    with pytest.raises(GroundingError, match=r"^mine: Cup has the volume .*; expected cubic metres above 0$"):
        VolumeGrounder({"Cup": volume}, "mine")


# Built-in sizes


def test_every_class_of_the_home_tbox_has_one_size_and_an_origin(home_tbox: TBox):
    rows = read_built_in()
    assert sorted(home_tbox.resolve(row["class"]) for row in rows) == sorted(home_tbox.by_iri)
    assert len(rows) == 102
    assert all(row["class"].startswith(("soma:", "dul:")) for row in rows)
    assert all(row["origin"].strip() for row in rows)


@pytest.mark.parametrize(("cls", "published"), [("soma:Refrigerator", 1.5), ("soma:Cup", 0.5e-3)])
def test_built_in_sizes_match_the_two_published_ones(cls: str, published: float):
    (row,) = (row for row in read_built_in() if row["class"] == cls)
    volume = float(row["width_m"]) * float(row["depth_m"]) * float(row["height_m"])
    assert volume == pytest.approx(published, rel=0.02)


def test_each_class_is_nearest_to_its_own_size(home_tbox: TBox):
    for row in read_built_in():
        size = (float(row["width_m"]), float(row["depth_m"]), float(row["height_m"]))
        assert ask(VolumeGrounder(), size, home_tbox).class_iri == home_tbox.resolve(row["class"])


def test_settings_contain_the_table(tmp_path: Path):
    table = write(tmp_path / "sizes.csv", HEADER + "Cup,0.1,0.1,0.1,\n")
    assert (VolumeGrounder().name, VolumeGrounder().is_calibrated) == ("volume", False)
    assert VolumeGrounder().settings == {"class_sizes": "built-in", "smallest_side_m": "0.001"}
    assert VolumeGrounder({"Cup": 1.0}).settings["class_sizes"] == "written by hand"
    assert VolumeGrounder.from_csv(table).settings["class_sizes"] == str(table)


# Sizes from a file


@pytest.mark.parametrize("written", ["Cup", "soma:Cup", SOMA + "Cup", " Cup "])
def test_accepts_local_names_curies_and_iris(home_tbox: TBox, tmp_path: Path, written: str):
    table = write(tmp_path / "sizes.csv", f"{HEADER}{written},0.1,0.2,0.5,measured\n")
    prediction = ask(VolumeGrounder.from_csv(table), (0.1, 0.1, 1.0), home_tbox)
    assert (prediction.class_iri, prediction.confidence) == (SOMA + "Cup", pytest.approx(1.0))


def test_ignores_other_columns_and_a_byte_order_mark(tmp_path: Path):
    text = '\ufefforigin,note,height_m,width_m,depth_m,class\n"a\nb",x,0.5,0.1,0.2,Cup\n\n,,1e-1,1,1,Crate\n'
    grounder = VolumeGrounder.from_csv(write(tmp_path / "sizes.csv", text))
    assert ask(grounder, (0.1, 0.1, 1.0)).candidates[0].class_iri == LAB + "Cup"
    assert ask(grounder, (1.0, 1.0, 0.1)).candidates[0].class_iri == LAB + "Crate"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "line 1 has the columns nothing, without class,width_m,depth_m,height_m,origin; expected class,width_m"),
        ("class,volume\nCup,1\n", "line 1 has the columns class,volume, without width_m,depth_m,height_m,origin"),
        (HEADER + "Cup,0.1,0.1,0.1,\nCrate,1,x,1,\n", "line 3: depth_m of Crate is 'x'; expected metres above 0"),
        (HEADER + "Cup,0.1,0.1\n", "line 2: height_m of Cup is ''; expected metres above 0"),
        (HEADER + "Cup,0.1,0,0.1,\n", "line 2: depth_m of Cup is '0'; expected metres above 0"),
        (HEADER + "Cup,1,5,1,2,1,1,\n", "line 2 has more cells than line 1; expected metres as in 0.08, with a point"),
        (HEADER + "Cup,-0.1,0.1,0.1,\n", "line 2: width_m of Cup is '-0.1'; expected metres above 0"),
        (HEADER + "Cup,nan,0.1,0.1,\n", "line 2: width_m of Cup is 'nan'; expected metres above 0"),
        (HEADER + "Cup,0.1,0.1,inf,\n", "line 2: height_m of Cup is 'inf'; expected metres above 0"),
        (HEADER + '"a\nb",1,1,1,\nCup,8 cm,1,1,\n', "line 4: width_m of Cup is '8 cm'; expected metres above 0"),
        (HEADER + ",0.1,0.1,0.1,\n", "line 2 names no class; expected an IRI, a CURIE or a local name"),
        (HEADER + f"soma:Cup,1,1,1,\n{SOMA}Cup,1,1,1,\n", f"line 3: {SOMA}Cup is already in line 2"),
        (HEADER + 'Cup,1,1,1,"measured\n', "line 2: unexpected end of data; expected a CSV file"),
        (HEADER + "Cup,1e200,1e200,1,\n", "Cup has the volume inf; expected cubic metres above 0"),
    ],
)
def test_reports_invalid_rows_with_their_line(tmp_path: Path, text: str, message: str):
    table = write(tmp_path / "sizes.csv", text)
    with pytest.raises(GroundingError) as caught:
        VolumeGrounder.from_csv(table)
    assert str(caught.value).startswith(f"{table}: {message}")


@pytest.mark.parametrize("content", [None, b"\xff\xfe\x00"])
def test_reports_an_unreadable_table(tmp_path: Path, content: bytes | None):
    table = tmp_path / "sizes.csv"
    if content is not None:
        table.write_bytes(content)
    with pytest.raises(GroundingError, match=r"sizes\.csv: cannot be read as a CSV file with the columns class,"):
        VolumeGrounder.from_csv(table)
