"""usd2kg eval: its output, and its errors."""

import csv
import hashlib
import json
import re
from pathlib import Path

import pytest

from tests.evaluation.conftest import omit_png_and_pdf
from tests.evaluation.test_fetch import FILES, Server
from tests.grounding.llm.servers import openai_reply, refuse, serve
from tests.scene.usda import component, cube, xform

GOLD = "path,class,also\n/Room/Table_1,Table,\n/Room/coffee_mug,Bowl,Cup\n/Room/Nowhere,Sofa,\n"


@pytest.fixture
def gold(tmp_path: Path) -> Path:
    path = tmp_path / "gold.csv"
    path.write_text(GOLD, encoding="utf-8")
    return path


def test_run_prints_json_in_the_units_of_the_study(
    run, room: Path, gold: Path, caplog: pytest.LogCaptureFixture
) -> None:
    done = run("eval", "run", room, "--gold", gold, "--json")
    assert (done.code, done.err) == (0, "")
    warning = f"{gold}: 1 of 3 gold paths are not on the stage {room}, /Room/Nowhere for one; they count as wrong"
    assert caplog.messages == [warning]
    data = json.loads(done.out)
    # Table is exact, the gold of the mug also accepts Cup, and the missing prim counts as wrong.
    assert (data["n"], data["answered"]) == (3, 2)
    assert data["ema"] == pytest.approx(100 / 3)
    assert data["ema_also"] == pytest.approx(200 / 3)
    assert 0 < data["hf1"] < 1
    for name in ("ema_interval", "ema_name_interval", "ema_also_interval", "hf1_interval"):
        lower, upper = data[name]
        assert lower <= upper
    assert [score["status"] for score in data["scores"]] == ["grounded", "grounded", "missing"]
    assert data["settings"]["regime"] == "semantic"


def test_objects_that_the_selection_misses_are_wrong_end_to_end(run, write_stage, tmp_path: Path) -> None:
    scene = write_stage(
        xform("Room", component("Shelf_1", cube("board"), cube("Cup_1")), component("Cup_2", cube("m")))
    )
    gold = tmp_path / "gold.csv"
    gold.write_text("path,class\n/Room/Shelf_1/Cup_1,Cup\n/Room/Cup_2,Cup\n", encoding="utf-8")
    data = json.loads(run("eval", "run", scene, "--gold", gold, "--json").out)
    assert data["selection"]["missed"] == ["/Room/Shelf_1/Cup_1"]
    assert (data["ema"], data["hf1"], data["answered"]) == (100, 1, 2)
    end_to_end = data["end_to_end"]
    assert (end_to_end["ema"], end_to_end["hf1"], end_to_end["answered"]) == (50, 0.5, 1)
    text = run("eval", "run", scene, "--gold", gold).out
    assert re.search(r"exact match end to end % +50\.0 ", text)
    assert re.search(r"HF1\) +1\.000 .*\n  end to end +0\.500 ", text)
    assert run("eval", "run", scene, "--gold", gold, "-o", tmp_path / "run.json").code == 0
    compared = run("eval", "compare", tmp_path / "run.json", tmp_path / "run.json")
    assert compared.out.startswith(f"A  100.0 % (50.0 % end to end)  {tmp_path}/run.json: lexical, semantic")


def test_run_prints_wrong_answers_with_reasons(run, room: Path, gold: Path) -> None:
    done = run("eval", "run", room, "--gold", gold)
    assert done.code == 0
    assert re.search(r"exact match \(EMA\) % +33\.3 ", done.out)
    few = "none +only 2 of 3 objects have an answer with a confidence"
    assert re.search(rf"EMA of the most confident 80 % +{few}\n +accepting a second label % +{few}\n", done.out)
    assert "/Room/coffee_mug" in done.out.partition("wrong")[2]
    assert "is a name for Cup" in done.out


@pytest.mark.parametrize("regime", ["abbreviated", "opaque", "opaque-anonymous"])
@pytest.mark.parametrize("grounder", ["lexical", "dictionary", "embedding", "volume"])
def test_every_grounder_runs_under_every_masked_regime(run, room: Path, gold: Path, regime: str, grounder: str) -> None:
    done = run("eval", "run", room, "--gold", gold, "--regime", regime, "--grounder", grounder, "--json")
    assert done.code == 0
    data = json.loads(done.out)
    assert (data["n"], data["grounder"], data["settings"]["regime"]) == (3, grounder, regime)


def test_rejects_gold_of_another_scene(run, room: Path, tmp_path: Path) -> None:
    gold = tmp_path / "other.csv"
    gold.write_text("path,class\n/Flat/Sofa,Sofa\n/Flat/Bed,DesignedFurniture\n", encoding="utf-8")
    done = run("eval", "run", room, "--gold", gold)
    assert (done.code, done.out) == (2, "")
    assert "none of its 2 paths is in" in done.err


def test_abbreviated_length_is_an_option(run, room: Path, gold: Path) -> None:
    shown = {}
    for length in (2, 6):
        options = ("--regime", "abbreviated", "--abbreviated-length", length, "--grounder", "dictionary", "--json")
        data = json.loads(run("eval", "run", room, "--gold", gold, *options).out)
        assert data["settings"]["abbreviated_length"] == str(length)
        shown[length] = data["scores"][1]["explanation"]
    # coffee_mug without vowels: cff, mg.
    assert shown == {2: "“cfmg” is not in the dictionary", 6: "“cffmg” is not in the dictionary"}


def test_volume_grounder_reads_class_sizes(run, room: Path, gold: Path, tmp_path: Path) -> None:
    sizes = tmp_path / "sizes.csv"
    sizes.write_text("class,width_m,depth_m,height_m,origin\nsoma:Sofa,1.6,0.8,0.7,mine\n", encoding="utf-8")
    options = ("--grounder", "volume", "--class-sizes", sizes, "--json")
    data = json.loads(run("eval", "run", room, "--gold", gold, *options).out)
    assert data["scores"][0]["answer"].endswith("#Sofa"), "the only class with a size"
    refused = run("eval", "run", room, "--gold", gold, "--class-sizes", sizes)
    assert (refused.code, "takes no class sizes" in refused.err) == (2, True)


def test_scores_answers_of_a_file(run, room: Path, gold: Path, tmp_path: Path) -> None:
    answers, stored = tmp_path / "mine.csv", tmp_path / "mine.json"
    answers.write_text("path,class,confidence\n/Room/Table_1,Table,0.9\n/Room/Apple,Bowl,0.5\n", encoding="utf-8")
    done = run("eval", "run", room, "--gold", gold, "--predictions", answers, "-o", stored, "--json")
    data = json.loads(done.out)
    assert done.err == f"{answers}: no row for 2 of 3 gold paths, /Room/coffee_mug for one; they count as wrong\n"
    assert (data["grounder"], data["n"], data["answered"], data["ema"]) == ("mine.csv", 3, 1, pytest.approx(100 / 3))
    assert [score["confidence"] for score in data["scores"]] == [0.9, None, None]
    assert "seconds" not in run("eval", "run", room, "--gold", gold, "--predictions", answers).out
    run("eval", "run", room, "--gold", gold, "-o", tmp_path / "lexical.json")
    compared = run("eval", "compare", stored, tmp_path / "lexical.json")
    assert compared.code == 0
    assert f"{stored}: mine.csv, unknown names, evidence unknown\n" in compared.out


@pytest.mark.parametrize("ending", ["csv", "json", "tsv"])
def test_scores_the_files_of_ground(run, room: Path, gold: Path, tmp_path: Path, ending: str) -> None:
    answers = tmp_path / f"mine.{ending}"
    assert run("ground", room, "-o", answers).code == 0
    found = json.loads(run("eval", "run", room, "--gold", gold, "--predictions", answers, "--json").out)
    direct = json.loads(run("eval", "run", room, "--gold", gold, "--json").out)
    assert [score["answer"] for score in found["scores"]] == [score["answer"] for score in direct["scores"]]
    for mine, own in zip(found["scores"], direct["scores"], strict=True):
        assert mine["confidence"] == pytest.approx(own["confidence"], abs=1e-4)


def test_rejects_answers_of_another_scene_and_options_of_grounders(run, room: Path, gold: Path, tmp_path: Path) -> None:
    answers = tmp_path / "mine.csv"
    answers.write_text("path,class\n/Flat/Sofa,Sofa\n", encoding="utf-8")
    done = run("eval", "run", room, "--gold", gold, "--predictions", answers)
    assert (done.code, done.out) == (2, "")
    assert f"{answers}: has no row for the 3 gold paths; expected the answers for this scene" in done.err
    done = run("eval", "run", room, "--gold", gold, "--predictions", answers, "--grounder", "volume")
    assert done.code == 2
    assert done.err == f"usd2kg: {answers}: the answers exist and no grounder is asked; leave out --grounder\n"


def test_compare_lists_differing_objects(run, room: Path, gold: Path, tmp_path: Path) -> None:
    for name, grounder in (("a.json", "lexical"), ("b.json", "dictionary")):
        assert run("eval", "run", room, "--gold", gold, "--grounder", grounder, "-o", tmp_path / name).code == 0
    data = json.loads(run("eval", "compare", tmp_path / "a.json", tmp_path / "b.json", "--json").out)
    assert (data["n"], data["only_first"], data["only_second"]) == (3, 1, 0)
    # One discordant pair: 2 * (1/2) = 1.
    assert data["p_value"] == 1.0
    assert [item["path"] for item in data["changed"]] == ["/Room/Table_1"]
    text = run("eval", "compare", tmp_path / "a.json", tmp_path / "b.json").out
    assert "only A right: 1, only B right: 0" in text


def test_compare_rejects_runs_on_different_ontologies(run, room: Path, gold: Path, tmp_path: Path) -> None:
    run("eval", "run", room, "--gold", gold, "-o", tmp_path / "a.json")
    data = json.loads((tmp_path / "a.json").read_text("utf-8"))
    (tmp_path / "b.json").write_text(json.dumps({**data, "ontology_hash": "sha256:other"}))
    done = run("eval", "compare", tmp_path / "a.json", tmp_path / "b.json")
    assert done.code == 2
    assert "used different ontologies" in done.err


def test_compare_rejects_runs_with_different_gold_labels(run, room: Path, gold: Path, tmp_path: Path) -> None:
    run("eval", "run", room, "--gold", gold, "-o", tmp_path / "a.json")
    gold.write_text(GOLD.replace("Table_1,Table", "Table_1,Sofa").replace("Bowl,Cup", "Bowl,"), encoding="utf-8")
    run("eval", "run", room, "--gold", gold, "-o", tmp_path / "b.json")
    done = run("eval", "compare", tmp_path / "a.json", tmp_path / "b.json")
    assert (done.code, done.out) == (2, "")
    assert done.err == (
        f"usd2kg: {tmp_path}/a.json and {tmp_path}/b.json have different gold labels for 1 of 3 objects, /Room/Table_1 "
        "for one: Table and Sofa; evaluate both with the same gold file\n"
    )


def test_compare_rejects_runs_on_different_scenes(run, room: Path, gold: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.usda"
    other.write_text(room.read_text("utf-8").replace("Apple", "Pear"), encoding="utf-8")
    for name, scene in (("a.json", room), ("b.json", other)):
        assert run("eval", "run", scene, "--gold", gold, "-o", tmp_path / name).code == 0
    done = run("eval", "compare", tmp_path / "a.json", tmp_path / "b.json")
    assert (done.code, done.out) == (2, "")
    assert f"used different scenes, or versions of a scene: {room} and {other}; compare runs on the same" in done.err


def test_compare_counts_the_objects_of_one_run_only(run, room: Path, gold: Path, tmp_path: Path) -> None:
    run("eval", "run", room, "--gold", gold, "-o", tmp_path / "a.json")
    gold.write_text("path,class\n/Room/Table_1,Table\n/Room/Apple,Bowl\n", encoding="utf-8")
    run("eval", "run", room, "--gold", gold, "-o", tmp_path / "b.json")
    files = tmp_path / "a.json", tmp_path / "b.json"
    data = json.loads(run("eval", "compare", *files, "--json").out)
    assert (data["n"], data["unpaired_first"], data["unpaired_second"]) == (1, 2, 1)
    said = "left out, since only one run has gold labels for them: 2 of A, 1 of B\n"
    assert said in run("eval", "compare", *files).out


def test_compare_names_files_and_differing_settings(run, room: Path, gold: Path, tmp_path: Path) -> None:
    run("eval", "run", room, "--gold", gold, "-o", tmp_path / "a.json")
    run("eval", "run", room, "--gold", gold, "--abstain", "-o", tmp_path / "b.json")
    files = tmp_path / "a.json", tmp_path / "b.json"
    first, second = run("eval", "compare", *files).out.splitlines()[:2]
    assert f"  {files[0]}: lexical, semantic names, evidence " in first
    assert first.endswith(", decision default")
    assert second.endswith(", decision hierarchical")
    data = json.loads(run("eval", "compare", *files, "--json").out)
    assert [data[key]["file"] for key in ("first", "second")] == [str(file) for file in files]
    assert data["second"]["run"].endswith(", decision hierarchical")


def test_compare_reads_runs_of_every_grounder(run, room: Path, gold: Path, tmp_path: Path) -> None:
    for grounder in ("embedding", "volume"):
        run("eval", "run", room, "--gold", gold, "--grounder", grounder, "-o", tmp_path / f"{grounder}.json")
    done = run("eval", "compare", tmp_path / "embedding.json", tmp_path / "volume.json")
    assert done.code == 0, done.err


def test_annotate_writes_a_template_that_reads_back(run, room: Path, tmp_path: Path) -> None:
    template = tmp_path / "new.csv"
    assert run("eval", "annotate", room, "-o", template).code == 0
    rows = list(csv.DictReader(template.read_text("utf-8").splitlines()))
    assert {"path", "class", "also", "words", "size_m"} <= set(rows[0])
    assert all(row["class"] == "" for row in rows)
    assert run("eval", "run", room, "--gold", template).code == 2, "no class is filled in"
    refused = run("eval", "annotate", room, "--suggest", "-o", template)
    assert (refused.code, "may hold labels" in refused.err) == (2, True)
    assert run("eval", "annotate", room, "--suggest", "--force", "-o", template).code == 0
    data = json.loads(run("eval", "run", room, "--gold", template, "--json").out)
    assert data["ema"] == 100.0, "the suggestions are the answers of the same grounder"


def test_suggestions_are_classes_of_the_ontology_that_run_reads(run, write_stage, tmp_path: Path) -> None:
    # usd2kg ground chooses the ontology of places for these names, which has more classes.
    names = ("PalletRack_1", "Forklift_1", "pallet_jack", "conveyor_belt", "loading_dock", "roof")
    scene = write_stage(xform("Warehouse", *(component(name, cube("mesh")) for name in names)))
    gold = tmp_path / "gold.csv"
    assert run("eval", "annotate", scene, "--suggest", "-o", gold).code == 0
    assert run("eval", "run", scene, "--gold", gold).code == 0


def test_agreement_of_two_annotators(run, gold: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.csv"
    other.write_text(GOLD.replace("Bowl,Cup", "Cup,"), encoding="utf-8")
    data = json.loads(run("eval", "agreement", gold, other, "--json").out)
    assert (data["n"], data["exact"], data["accepted"]) == (3, pytest.approx(2 / 3), 1.0)
    assert [item["path"] for item in data["disagreements"]] == ["/Room/coffee_mug"]
    text = run("eval", "agreement", gold, other).out
    assert "Cohen's kappa" in text


def test_reproduce_asks_again_for_answers_that_a_model_failed_to_give(
    run, room: Path, gold: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "completions.sqlite"))
    monkeypatch.setenv("OPENAI_API_KEY", "sk-secret-4711")
    cup = openai_reply(json.dumps({"1": {"class": "Cup"}}))
    with serve(cup, refuse(401, "no access"), cup) as server:
        matrix = tmp_path / "matrix.toml"
        matrix.write_text(
            f'grounders = ["llm-A:openai:m@{server.url}/v1"]\nregimes = ["semantic"]\n'
            f'[[scene]]\nname = "room"\npath = "{room.name}"\ngold = "{gold.name}"\n',
            encoding="utf-8",
        )
        first, second, third = (run("eval", "reproduce", matrix, "-o", tmp_path / "out") for _ in range(3))
        asked = len(server.received)
    assert (first.code, second.code, third.code) == (2, 0, 0)
    assert "(1 object failed)" in first.err
    assert "1 of 1 results lack 1 answers (model 'openai:m" in first.err
    assert "no access" in first.err
    assert "run the same command again to complete them" in first.err
    assert (tmp_path / "out/report.md").exists()
    assert "stored" not in second.err
    assert "(stored)" in third.err
    # Two objects of the gold are on the stage; the answer that the first run received is not asked for again.
    assert asked == 3


def test_reproduce_writes_reports_and_resumes(run, room: Path, gold: Path, tmp_path: Path, monkeypatch) -> None:
    omit_png_and_pdf(monkeypatch)
    matrix = tmp_path / "matrix.toml"
    matrix.write_text(
        f'title = "one room"\nrepeats = 2\ngrounders = ["lexical", "dictionary"]\nregimes = ["semantic", "opaque"]\n'
        f'[[scene]]\nname = "room"\npath = "{room}"\ngold = "{gold}"\n'
    )
    done = run("eval", "reproduce", matrix, "-o", tmp_path / "out")
    assert done.code == 0
    assert "lexical, dictionary: run once instead of 2 times, since the answers are always the same\n" in done.err
    assert "[4/4] room, dictionary, opaque: EMA 0.0" in done.err
    for name in ("report.md", "report.tex", "report.html", "results.csv", "results.json"):
        assert str(tmp_path / "out" / name) in done.out
        assert (tmp_path / "out" / name).stat().st_size > 0
    again = run("eval", "reproduce", matrix, "-o", tmp_path / "out")
    assert again.err.count("(stored)") == 4


def test_reproduce_rejects_options_of_language_models_without_one(run, room: Path, gold: Path, tmp_path: Path) -> None:
    matrix = tmp_path / "matrix.toml"
    matrix.write_text(f'grounders = ["lexical"]\n[[scene]]\npath = "{room}"\ngold = "{gold}"\n')
    for option in (("--objects-per-prompt", "20"), ("--thinking",), ("--replay",)):
        done = run("eval", "reproduce", matrix, *option, "-o", tmp_path / "out")
        assert (done.code, done.out) == (2, "")
        assert done.err == f"usd2kg: {option[0]} needs a language model; name one with a grounder llm-B:MODEL\n"


def test_kitchen_set_rejects_a_folder_without_root_layer(run, tmp_path: Path) -> None:
    done = run("eval", "kitchen-set", tmp_path)
    assert (done.code, done.out) == (2, "")
    assert "no Kitchen_set.usd in it" in done.err
    assert done.err.count("\n") == 1


def test_kitchen_set_lists_objects_without_gold(run, tmp_path: Path) -> None:
    folder = tmp_path / "Kitchen_set"
    folder.mkdir()
    (folder / "Kitchen_set.usd").write_text(
        '#usda 1.0\ndef Xform "Kitchen" (kind = "assembly")\n{\n  def Cube "a" (kind = "component")\n  {\n  }\n}\n'
    )
    done = run("eval", "kitchen-set", tmp_path)
    assert (done.code, done.out) == (0, "/Kitchen/a\n")
    assert "1 object, 1 of them with geometry and not inside another object (the study has 125)" in done.err
    assert "label these objects with usd2kg eval annotate" in done.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("eval", "run", "{room}", "--gold", "none.csv"), "none.csv: cannot be read as gold labels"),
        (("eval", "run", "{room}", "--gold", "{gold}", "--regime", "fog"), "regime 'fog' is unknown"),
        (("eval", "run", "{room}", "--gold", "{gold}", "--grounder", "oracle"), "grounder 'oracle' is unknown"),
        (("eval", "run", "none.usda", "--gold", "{gold}"), "none.usda: no such file"),
        (("eval", "reproduce", "none.toml"), "none.toml: cannot be read as a matrix"),
        (("eval", "compare", "none.json", "none.json"), "none.json: cannot be read as a run"),
        (("eval", "agreement", "{gold}", "none.csv"), "none.csv: cannot be read as gold labels"),
    ],
)
def test_rejects_invalid_input(run, room: Path, gold: Path, arguments: tuple[str, ...], message: str) -> None:
    done = run(*(argument.format(room=room, gold=gold) for argument in arguments))
    assert done.code == 2
    assert message in done.err
    assert done.err.count("\n") == 1
    assert done.out == ""


def test_fetch_prints_a_matrix_that_can_be_reproduced(run, tmp_path: Path) -> None:
    server = Server()
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in FILES.items()}
    entries = [
        f'[[scene.file]]\nfile = "{name[1:]}"\naddress = "{server.url}{name}"\nsha256 = "{digest}"\n'
        for name, digest in digests.items()
    ]
    head = '[[scene]]\nname = "room"\nlicence = "CC0-1.0"\nstage = "room.usda"\ngold = "gold.csv"\n'
    (tmp_path / "manifest.toml").write_text(head + "".join(entries), encoding="utf-8")
    try:
        unknown = run("eval", "fetch", tmp_path / "manifest.toml", "hall")
        done = run("eval", "fetch", tmp_path / "manifest.toml", "room", "--into", tmp_path / "scenes")
    finally:
        server.close()
    assert (unknown.code, unknown.out) == (2, "")
    assert "manifest.toml: has no scene 'hall'; expected one of room" in unknown.err
    assert (done.code, done.out) == (0, f"{tmp_path}/scenes/matrix.toml\n")
    assert "room: 2 files, licence CC0-1.0" in done.err
    matrix = tmp_path / "scenes/matrix.toml"
    assert 'gold = "room/gold.csv"' in matrix.read_text("utf-8")
    assert run("eval", "run", tmp_path / "scenes/room/room.usda", "--gold", tmp_path / "scenes/room/gold.csv").code == 0
