"""Language models on the command line, behind a local server."""

import csv
import io
import json
import re
from dataclasses import replace
from itertools import repeat
from pathlib import Path

import pyoxigraph as ox
import pytest

from tests.cli.conftest import Run
from tests.grounding.llm.servers import Reply, openai_events, openai_reply, refuse, serve
from tests.scene.usda import component, cube, xform
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.factory import parse_llm_name
from usd2kg.grounding.llm.prompt_options import Strategy

KEY = "sk-very-secret-4711"


@pytest.fixture
def kitchen(write_stage) -> Path:
    return write_stage(
        xform("Kitchen", *(component(name, cube("mesh", size=0.1)) for name in ("mug_1", "mug_2", "jar")))
    )


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "said.sqlite"))
    monkeypatch.setenv("OPENAI_API_KEY", KEY)


def classes(text: str) -> dict[str, str]:
    return {row["path"]: row["class"].rpartition("#")[2] for row in csv.DictReader(io.StringIO(text))}


def cup(count: int = 1) -> str:
    return json.dumps({str(number): {"class": "Cup"} for number in range(1, count + 1)})


def test_rerun_uses_cached_completions(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        model = f"llm-B:openai:test@{server.url}/v1"
        first = run("ground", kitchen, "--grounder", model)
        asked = len(server.received)
        again = run("ground", kitchen, "--grounder", model)
    assert first.code == again.code == 0
    assert classes(first.out) == {f"/Kitchen/{name}": "Cup" for name in ("mug_1", "mug_2", "jar")}
    assert again.out == first.out
    # The two mugs have the same evidence.
    assert asked == len(server.received) == 2
    assert "2 new completions, 0 cached" in first.err
    assert "0 new completions, 2 cached" in again.err
    assert KEY not in first.out + first.err


def test_response_schema_offers_only_classes_of_the_ontology(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        run("ground", kitchen, "--grounder", f"llm-c:openai:test@{server.url}/v1")
        body = server.received[0].body
    row = body["response_format"]["json_schema"]["schema"]["properties"]["1"]
    assert list(row["properties"]) == ["reasoning", "class"]
    assert "Cup" in row["properties"]["class"]["enum"]
    assert "Chalice" not in row["properties"]["class"]["enum"]
    assert body["temperature"] == 0


def test_one_prompt_can_ask_about_several_objects(run: Run, kitchen: Path):
    with serve(openai_reply(cup(2))) as server:
        done = run("ground", kitchen, "--grounder", f"llm-B:openai:test@{server.url}/v1", "--objects-per-prompt", "10")
        assert len(server.received) == 1
    assert set(classes(done.out).values()) == {"Cup"}


def test_asks_once_about_a_concept_that_the_lexical_grounder_is_unsure_of(run: Run, write_stage):
    names = ("mug_1", *(f"qzxv_{number}" for number in range(20)))
    scene = write_stage(xform("Kitchen", *(component(name, cube("mesh", size=0.1)) for name in names)))
    with serve(openai_reply(cup())) as server:
        model = f"llm-concept:openai:test@{server.url}/v1"
        done = run("ground", scene, "--grounder", model, "--cascade", "0.8", "--format", "json")
        assert len(server.received) == 1, done.err
        received = server.received[0]
    prompt = received.body["messages"][-1]["content"]
    assert len(re.findall(r'^names: "qzxv" \(\d\d times\)$', prompt, re.M)) == 1
    assert "mug" not in prompt.partition("siblings")[0]
    found = {p["prim_path"]: p for p in json.loads(done.out)["predictions"]}
    assert found["/Kitchen/mug_1"]["grounder"] == "lexical"
    assert {found[f"/Kitchen/qzxv_{n}"]["class_iri"].rpartition("#")[2] for n in range(20)} == {"Cup"}
    assert " objects in 1 prompt: 1 new completion," in done.err


def test_dry_run_prints_prompts_without_requests(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        done = run("ground", kitchen, "--grounder", f"llm-B:openai:test@{server.url}/v1", "--dry-run")
        assert server.received == []
    assert done.code == 0
    assert done.out.count("=== prompt ") == 2
    assert 'name: "mug_1"' in done.out
    assert "2 prompts for 3 objects, about" in done.err


class TestPrice:
    """Two prompts, each with 100 input and 7 output tokens by the count of the server."""

    def test_reports_cost_at_the_given_price(self, run: Run, kitchen: Path):
        with serve(openai_reply(cup())) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            first = run("ground", kitchen, "--grounder", model, "--price", "10/100")
            again = run("ground", kitchen, "--grounder", model, "--price", "10/100")
        # 2 * (100 * 10 + 7 * 100) / 1,000,000
        assert "14 output tokens, $0.0034, " in first.err
        assert "0 output tokens, $0, " in again.err

    def test_price_of_a_private_server_is_unknown(self, run: Run, kitchen: Path):
        with serve(openai_reply(cup())) as server:
            done = run("ground", kitchen, "--grounder", f"llm-A:openai:gpt-4o@{server.url}/v1")
        assert "14 output tokens, price unknown, " in done.err

    def test_spent_budget_sends_no_request(self, run: Run, kitchen: Path):
        with serve(openai_reply(cup())) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            done = run("ground", kitchen, "--grounder", model, "--price", "10/100", "--budget", "0", "--format", "json")
            assert server.received == []
        found = json.loads(done.out)["predictions"]
        reason = "not asked: $0 are spent of a budget of $0; raise --budget"
        assert {p["explanation"] for p in found} == {reason}
        assert done.code == 2
        assert f"the model completed none of 2 prompts ({reason}); the output contains no classes" in done.err

    def test_evaluation_without_budget_fails_and_keeps_its_figures(self, run: Run, kitchen: Path):
        Path("gold.csv").write_text("path,class\n/Kitchen/mug_1,Cup\n", "utf-8")
        with serve(openai_reply(cup())) as server:
            model = ("--grounder", f"llm-A:openai:test@{server.url}/v1", "--price", "10/100", "--budget", "0")
            done = run("eval", "run", kitchen, "--gold", "gold.csv", *model, "--json")
        assert (done.code, json.loads(done.out)["answered"]) == (2, 0)
        assert "the model completed none of 1 prompts (not asked: $0 are spent of a budget of $0;" in done.err

    def test_budget_stops_the_run_and_keeps_its_results(self, run: Run, kitchen: Path):
        options = ("--each-object", "--price", "10/100", "--budget", "0.001", "--concurrency", "1")
        with serve(openai_reply(cup())) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            done = run("ground", kitchen, "--grounder", model, *options, "--format", "json")
            assert len(server.received) == 1
        found = json.loads(done.out)["predictions"]
        assert done.code == 0
        assert [p["status"] for p in found].count("grounded") == 1
        explanation = "not asked: $0.0017 are spent of a budget of $0.0010; raise --budget"
        assert [p["explanation"] for p in found].count(explanation) == 2
        assert done.err.splitlines()[-1] == f"2 prompts without a completion ({explanation})"

    def test_rejects_a_budget_without_price(self, run: Run, kitchen: Path):
        with serve(openai_reply(cup())) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            done = run("ground", kitchen, "--grounder", model, "--budget", "1")
            assert server.received == []
        assert (done.code, done.out) == (2, "")
        assert "has no list price, which --budget requires; give one with --price INPUT/OUTPUT" in done.err

    def test_dry_run_estimates_the_list_price(self, run: Run, kitchen: Path):
        done = run("ground", kitchen, "--grounder", "llm-A:google:gemini-2.5-flash", "--dry-run")
        found = re.search(r"about ([\d,]+) input tokens \(.*\) and (\d+) output tokens, about \$(0\.\d{4})$", done.err)
        assert found is not None
        paid_in, paid_out = (int(found[group].replace(",", "")) for group in (1, 2))
        assert float(found[3]) == pytest.approx((0.30 * paid_in + 2.50 * paid_out) / 1e6, abs=0.0001)

    def test_dry_run_uses_the_given_price(self, run: Run, kitchen: Path):
        model = "llm-A:openai:test@http://localhost:1/v1"
        unknown = run("ground", kitchen, "--grounder", model, "--dry-run")
        stated = run("ground", kitchen, "--grounder", model, "--dry-run", "--price", "0/1000000")
        assert unknown.err.endswith(" output tokens, price unknown\n")
        tokens = re.search(r"and (\d+) output tokens, about \$(\d+)\.00", stated.err)
        assert tokens is not None
        assert tokens[1] == tokens[2]


class TestTraffic:
    def test_reports_requests_and_waits(self, run: Run, kitchen: Path):
        with serve(refuse(429, "slow down", Retry_After="0"), openai_reply(cup())) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            done = run("ground", kitchen, "--grounder", model, "--concurrency", "1")
        assert "; 3 requests sent, 1 retried, 1 wait of 0.0 s in total; " in done.err

    def test_limits_the_request_rate(self, run: Run, kitchen: Path):
        with serve(openai_reply(cup())) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            done = run("ground", kitchen, "--grounder", model, "--requests-per-minute", "600", "--each-object")
        # The second and third request are due after 0.1 s and 0.2 s.
        assert re.search(r"; 3 requests sent, 0 retried, [12] waits? of 0\.[123] s in total; ", done.err)

    @pytest.mark.parametrize("most", [1, 3])
    def test_limits_concurrent_requests(self, run: Run, kitchen: Path, most: int):
        with serve(replace(openai_reply(cup()), pause_s=0.05)) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            run("ground", kitchen, "--grounder", model, "--each-object", "--concurrency", str(most))
            assert server.most_at_once == most

    def test_replay_sends_no_request(self, run: Run, kitchen: Path):
        with serve(openai_reply(cup())) as server:
            model = f"llm-A:openai:test@{server.url}/v1"
            run("ground", kitchen, "--grounder", model)
            done = run("ground", kitchen, "--grounder", model, "--replay")
            assert len(server.received) == 2
        assert "; 0 requests sent, 0 retried, 0 waits of 0.0 s in total; " in done.err


def test_cuts_off_a_degenerate_completion_and_estimates_its_tokens(run: Run, kitchen: Path):
    with serve(Reply(events=lambda: openai_events(repeat("la la la ")))) as server:
        done = run("ground", kitchen, "--grounder", f"llm-A:openai:test@{server.url}/v1", "--format", "json")
    assert {found["status"] for found in json.loads(done.out)["predictions"]} == {"unreadable"}
    # Two prompts and a repair of each.
    assert "2 repairs, 4 degenerate" in done.err
    assert re.search(r" output tokens \([0-9,]+ of all estimated\), ", done.err)


def test_confidence_is_the_probability_of_the_class_tokens(run: Run, kitchen: Path):
    tokens = [('{"1": {"class": "', -0.5), ("C", -0.25), ("up", -0.25), ('"}}', -0.5)]
    with serve(openai_reply(cup(), tokens=tokens)) as server:
        done = run("ground", kitchen, "--grounder", f"llm-A:openai:test@{server.url}/v1", "--format", "json")
    assert {found["confidence"] for found in json.loads(done.out)["predictions"]} == {0.6065}


def test_reports_a_server_error_for_each_object(run: Run, kitchen: Path):
    with serve(refuse(401, f"bad key {KEY}")) as server:
        done = run("ground", kitchen, "--grounder", f"llm-B:openai:test@{server.url}/v1", "--format", "json")
    predictions = json.loads(done.out)["predictions"]
    assert {p["status"] for p in predictions} == {"failed"}
    assert "status 401" in predictions[0]["explanation"]
    assert KEY not in done.out + done.err
    assert "3 objects without a class" in done.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--grounder", "llm-B:nobody:model"), "expected google:NAME, anthropic:NAME or openai:NAME"),
        (
            ("--grounder", "llm-D:openai:x@http://localhost:1/v1"),
            "expected llm-A:MODEL, llm-B:MODEL, llm-C:MODEL, llm-auto:MODEL or llm-concept:MODEL",
        ),
        (("--dry-run",), "--dry-run needs a language model; name one with --grounder"),
        (("--cascade", "0.5"), "--cascade needs a language model; name one with --grounder"),
        (("--budget", "0"), "--budget needs a language model; name one with --grounder"),
        (("--price", "1/2"), "--price needs a language model; name one with --grounder"),
        (("--shortlist", "3"), "--shortlist needs a language model; name one with --grounder"),
        (("--samples", "2"), "--samples needs a language model; name one with --grounder"),
        (("--temperature", "0"), "--temperature needs a language model; name one with --grounder"),
        (("--class-tree",), "--class-tree needs a language model; name one with --grounder"),
        (("--replay",), "--replay needs a language model; name one with --grounder"),
        (("--refresh",), "--refresh needs a language model; name one with --grounder"),
        (("--completions", "c.sqlite"), "--completions needs a language model; name one with --grounder"),
        (("--calibration", "c.json"), "--calibration needs a language model; name one with --grounder"),
        (("--grounder", "llm-A:openai:x@http://localhost:1/v1", "--price", "1"), "--price '1': no two prices in it"),
    ],
)
def test_rejects_invalid_model_options(run: Run, kitchen: Path, arguments, message: str):
    done = run("ground", kitchen, *arguments)
    assert done.code == 2
    assert message in done.err
    assert done.out == ""


def test_cascade_asks_only_about_uncertain_objects(run: Run, write_stage):
    things = component("Cup", cube("mesh", size=0.1)), component("xqzv", cube("mesh", size=7))
    scene = write_stage(xform("Kitchen", *things))
    with serve(openai_reply(json.dumps({"1": {"class": "Bowl"}}))) as server:
        model = f"llm-B:openai:test@{server.url}/v1"
        plan = run("ground", scene, "--grounder", model, "--cascade", "0.8", "--dry-run")
        done = run("ground", scene, "--grounder", model, "--cascade", "0.8")
        assert len(server.received) == 1
    assert "1 prompt for 1 object," in plan.err
    assert classes(done.out) == {"/Kitchen/Cup": "Cup", "/Kitchen/xqzv": "Bowl"}
    assert done.err.splitlines()[0].split() == ["tier", "objects", "tokens", "price", "seconds"]
    assert [line.split()[:2] for line in done.err.splitlines()[1:3]] == [["lexical", "1"], ["llm", "1"]]


def test_shortlist_limits_the_offered_classes(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        model = f"llm-B:openai:test@{server.url}/v1"
        run("ground", kitchen, "--grounder", model, "--shortlist", "3")
        schemas = [received.body["response_format"]["json_schema"]["schema"] for received in server.received]
    offered = [schema["properties"]["1"]["properties"]["class"]["enum"] for schema in schemas]
    assert any("Cup" in names for names in offered)
    assert all("DesignedArtifact" in names and len(names) < 25 for names in offered)


def test_threads_are_those_of_the_weights(run: Run, kitchen: Path, monkeypatch: pytest.MonkeyPatch):
    opened = []

    def open_weights(model: str, *, threads: int) -> object:
        opened.append((model, threads))
        raise GroundingError("no weights")

    monkeypatch.setattr("usd2kg.grounding.llm.factory.open_local", open_weights)
    assert "no weights" in run("ground", kitchen, "--grounder", "llm-A:gguf:m.gguf", "--threads", "4").err
    assert opened == [("gguf:m.gguf", 4)]


def test_the_best_candidates_come_first(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        model = f"llm-B:openai:test@{server.url}/v1"
        refused = run("ground", kitchen, "--grounder", model, "--candidates-first")
        run("ground", kitchen, "--grounder", model, "--shortlist", "3", "--candidates-first")
        schemas = [received.body["response_format"]["json_schema"]["schema"] for received in server.received]
    assert "expected --shortlist K with --candidates-first" in refused.err
    offered = [schema["properties"]["1"]["properties"]["class"]["enum"] for schema in schemas]
    assert "Cup" in [names[0] for names in offered]


def test_replays_a_recording_without_key_or_server(run: Run, kitchen: Path, monkeypatch: pytest.MonkeyPatch):
    with serve(openai_reply(cup())) as server:
        model = f"llm-B:openai:test@{server.url}/v1"
        first = run("ground", kitchen, "--grounder", model)
    exported = run("completions", "export", "said.jsonl")
    assert "2 completions written" in exported.err
    assert KEY not in Path("said.jsonl").read_text("utf-8")
    monkeypatch.delenv("OPENAI_API_KEY")
    imported = run("completions", "import", "said.jsonl", "--completions", "elsewhere.sqlite")
    assert "2 new completions" in imported.err
    again = run("ground", kitchen, "--grounder", model, "--replay", "--completions", "elsewhere.sqlite")
    assert again.out == first.out
    other = model.replace("openai:test", "openai:other")
    empty = run(
        "ground", kitchen, "--grounder", other, "--replay", "--completions", "elsewhere.sqlite", "--format", "json"
    )
    explanations = {found["explanation"] for found in json.loads(empty.out)["predictions"]}
    assert any("leave out --replay to ask it" in text for text in explanations)


def test_rejects_a_cache_that_does_not_exist(run: Run, kitchen: Path):
    said = "usd2kg: none.sqlite: no such cache of completions; correct --completions or USD2KG_CACHE\n"
    for command in (
        ("completions", "export", "e.jsonl"),
        ("ground", kitchen, "--grounder", "llm-A:openai:gpt-4o", "--replay"),
    ):
        done = run(*command, "--completions", "none.sqlite")
        assert (done.code, done.out, done.err) == (2, "", said)
    assert list(Path().iterdir()) == []


def test_build_and_eval_run_accept_a_model(run: Run, kitchen: Path):
    Path("gold.csv").write_text("path,class,also\n/Kitchen/mug_1,Cup,\n/Kitchen/jar,Jar,\n", "utf-8")
    with serve(openai_reply(cup())) as server:
        model = f"llm-B:openai:test@{server.url}/v1"
        built = run("build", kitchen, "--grounder", model, "-o", "kitchen.ttl")
        scored = run("eval", "run", kitchen, "--gold", "gold.csv", "--grounder", model, "--json")
    assert built.code == scored.code == 0
    cups = [triple for triple in ox.parse(path="kitchen.ttl") if str(triple.object).endswith("#Cup>")]
    assert len({triple.subject for triple in cups if "type" in str(triple.predicate)}) == 3
    assert json.loads(scored.out)["ema"] == 50.0


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("llm-A:google:gemini-2.5-flash", ("google:gemini-2.5-flash", Strategy.NAME_ONLY)),
        ("llm-c:openai:x@http://localhost:8000/v1", ("openai:x@http://localhost:8000/v1", Strategy.CHAIN_OF_THOUGHT)),
        ("llm:openai:x", ("openai:x", Strategy.CONTEXT)),
    ],
)
def test_parses_strategy_and_model(name: str, expected: tuple[str, Strategy]):
    assert parse_llm_name(name) == expected


@pytest.mark.parametrize("name", ["llm-D:openai:x", "llm-AB:openai:x", "llm-B:", "llm-B"])
def test_rejects_other_grounder_names(name: str):
    with pytest.raises(GroundingError, match="expected llm-A:MODEL"):
        parse_llm_name(name)


def test_decided_objects_become_examples(run: Run, kitchen: Path, tmp_path: Path):
    queue, filled = tmp_path / "queue.csv", tmp_path / "filled.csv"
    with serve(*repeat(openai_reply(cup()), 5)) as server:
        model = ("--grounder", f"llm-B:openai:test@{server.url}/v1")
        first = run("ground", kitchen, *model, "--queue", queue, "--person", "1")
        assert "3 objects to review in" in first.err
        rows = list(csv.DictReader(queue.read_text("utf-8").splitlines()))
        assert {row["answer"] for row in rows} == {"Cup"}
        text = queue.read_text("utf-8").replace("/Kitchen/jar,,", "/Kitchen/jar,Jar,")
        filled.write_text(text, "utf-8")
        server.received.clear()
        second = run("ground", kitchen, *model, "--decisions", filled, "--examples", "4")
        (request,) = server.received
    assert classes(second.out)["/Kitchen/jar"] == "Jar"
    assert [line.split()[:2] for line in second.err.splitlines()[1:3]] == [["llm", "2"], ["person", "1"]]
    prompt = request.body["messages"][0]["content"]
    assert 'example 1\nname: "jar"' in prompt
    assert "class: Jar\n</examples>" in prompt


def test_sends_thumbnails(run: Run, kitchen: Path):
    with serve(*repeat(openai_reply(cup()), 2)) as server:
        run("ground", kitchen, "--grounder", f"llm-B:openai:test@{server.url}/v1", "--thumbnails")
        parts = server.received[0].body["messages"][-1]["content"]
    urls = [part["image_url"]["url"] for part in parts if part["type"] == "image_url"]
    assert len(set(urls)) == 2, "the object alone and in its place"
    assert all(url.startswith("data:image/png;base64,iVBOR") for url in urls)


def test_majority_of_samples_wins(run: Run, kitchen: Path):
    said = [openai_reply(json.dumps({"1": {"class": name}})) for name in ("Bowl", "Cup", "Cup")]
    with serve(*said, *said) as server:
        model = f"llm-A:openai:test@{server.url}/v1"
        done = run("ground", kitchen, "--grounder", model, "--samples", "3", "--concurrency", "1", "--format", "json")
        assert {request.body["temperature"] for request in server.received} == {0.7}
    confidences = {row["prim_path"]: row["confidence"] for row in json.loads(done.out)["predictions"]}
    assert set(confidences.values()) == {0.6667} or set(confidences.values()) == {2 / 3}


def test_build_reads_decisions_and_rejects_dry_run(run: Run, kitchen: Path, tmp_path: Path):
    decided = tmp_path / "decided.csv"
    decided.write_text("path,class\n/Kitchen/jar,Bowl\n", "utf-8")
    done = run("build", kitchen, "--decisions", decided, "-o", tmp_path / "graph.ttl")
    assert "person" in done.err
    graph = ox.Store()
    graph.load(path=str(tmp_path / "graph.ttl"), format=ox.RdfFormat.TURTLE)
    kinds = graph.query("SELECT ?c WHERE { ?x <https://w3id.org/usd2kg#primPath> '/Kitchen/jar' ; a ?c }")
    assert any(str(row["c"].value).endswith("#Bowl") for row in kinds)
    refused = run("build", kitchen, "--grounder", "llm-B:openai:x@http://localhost:1/v1", "--dry-run")
    assert refused.code == 2
    assert "use it with usd2kg ground" in refused.err


def test_scores_tiers_and_calibrates_a_model(run: Run, write_stage, tmp_path: Path):
    classes_of = {
        f"{word}_{letter}": cls for letter in "abcdefghijkl" for word, cls in (("cup", "Cup"), ("xqzv", "Bowl"))
    }
    things = (component(name, cube("mesh", size=0.1 if cls == "Cup" else 7)) for name, cls in classes_of.items())
    scene = write_stage(xform("Kitchen", *things))
    gold = tmp_path / "gold.csv"
    gold.write_text("path,class\n" + "".join(f"/Kitchen/{n},{cls}\n" for n, cls in classes_of.items()), "utf-8")
    with serve(*[openai_reply(cup())] * len(classes_of)) as server:
        model = ("--grounder", f"llm-A:openai:test@{server.url}/v1", "--each-object")
        alone = run("eval", "run", scene, "--gold", gold, *model, "-o", "alone.json")
        assert "tier" not in alone.out
        tiers = run("eval", "run", scene, "--gold", gold, *model, "--cascade", "0.8", "--replay")
    assert [line.split() for line in tiers.out.splitlines()[-2:]] == [
        ["lexical", "12", "100.0", "100.0"],
        ["llm", "12", "0.0", "0.0"],
    ]
    data = json.loads(Path("alone.json").read_text("utf-8"))
    for number, score in enumerate(data["scores"]):
        score["confidence"] = 0.9 if number % 2 == 0 else 0.6
    Path("alone.json").write_text(json.dumps(data), "utf-8")
    fitted = run("eval", "calibrate", "alone.json", "-o", "calibration.json")
    assert "fitted on 24 answers" in fitted.err
    again = run("ground", scene, *model, "--replay", "--calibration", "calibration.json", "--format", "json")
    assert json.loads(again.out)["is_calibrated"] is True
    assert re.fullmatch(r"\S+ [+-]\S+ logit", json.loads(again.out)["settings"]["calibration"])
    other = run("ground", scene, *model, "--replay", "--calibration", "calibration.json", "--shortlist", "3")
    assert (other.code, other.out) == (2, "")
    assert "calibration.json: was fitted for other confidences (classes flat, model openai:test@" in other.err
    assert ", shortlist 3, strategy A, temperature 0, thinking false); fit a calibration on such runs with" in other.err
    for number, score in enumerate(data["scores"]):
        score["confidence"] = 0.6 if number % 2 == 0 else 0.9
    Path("reversed.json").write_text(json.dumps(data), "utf-8")
    negative = run("eval", "calibrate", "reversed.json", "-o", "negative.json")
    assert negative.code == 0
    assert re.search(r"the slope is -\S+: answers of a higher confidence are not more often right, so", negative.err)
    Path("other.json").write_text(json.dumps({**data, "settings": {**data["settings"], "model": "openai:other"}}))
    mixed = run("eval", "calibrate", "alone.json", "other.json", "-o", "mixed.json")
    assert (mixed.code, "llm, openai:other, strategy A, semantic names" in mixed.err) == (2, True)


class TestAlignment:
    """`ontology align --model` asks once per ontology."""

    ANSWER = json.dumps({"1": {"belongs": ["guitar", "flux capacitor"], "not": []}})

    def test_writes_rows_and_cost_and_replays_them(self, run: Run, lab: Path, tmp_path: Path):
        with serve(openai_reply(self.ANSWER)) as server:
            model = f"openai:test@{server.url}/v1"
            first = run("ontology", "align", lab, "--model", model, "-o", tmp_path / "lab.sssom.tsv")
            assert len(server.received) == 1
        assert (first.code, first.out) == (0, "")
        assert "prompt without all answers: the answer has no row for 2 of 3 classes" in first.err
        assert f"3 rows about 1 of 3 classes by {model}" in first.err
        assert "1 prompt: 1 new completion, 0 cached, 0 prompts failed; 1 request sent" in first.err
        text = (tmp_path / "lab.sssom.tsv").read_text("utf-8")
        assert "flux capacitor\trdfs literal\tskos:exactMatch" in text
        assert KEY not in text + first.err
        again = run("ontology", "align", lab, "--model", model, "--replay")
        assert (again.code, again.out) == (0, text)
        assert "0 new completions, 1 cached" in again.err

    def test_a_dry_run_prints_the_prompts(self, run: Run, lab: Path):
        done = run("ontology", "align", lab, "--model", "openai:test@http://127.0.0.1:9/v1", "--dry-run")
        assert done.code == 0
        assert "=== prompt 1 of 1 ===\nWhich things belong to each of these classes?\n1. " in done.out
        assert "1 prompt about 3 classes, about " in done.err

    def test_a_failing_model_leaves_the_alignment_that_is_built(self, run: Run, lab: Path):
        with serve(refuse(401, "no")) as server:
            done = run("ontology", "align", lab, "--model", f"openai:test@{server.url}/v1")
        assert (done.code, done.out) == (0, run("ontology", "align", lab).out)
        assert "status 401: no; expected" in done.err

    def test_options_of_models_need_one(self, run: Run, lab: Path):
        done = run("ontology", "align", lab, "--budget", "1")
        assert (done.code, done.out) == (2, "")
        assert done.err == "usd2kg: --budget needs a language model; name one with --model MODEL\n"


REFUSED = "the model completed none of 2 prompts (model "


def test_ground_fails_if_all_prompts_fail_and_keeps_the_mapping(run: Run, kitchen: Path):
    with serve(refuse(401, "bad key")) as server:
        done = run("ground", kitchen, "--grounder", f"llm-B:openai:x@{server.url}/v1", "-o", "m.csv")
    assert done.code == 2
    last = done.err.splitlines()[-1]
    assert last.startswith(f"usd2kg: llm-B:openai:x@{server.url}/v1: {REFUSED}"), last
    assert "status 401" in last
    assert last.endswith("the output contains no classes from the model")
    assert set(classes(Path("m.csv").read_text()).values()) == {""}


def test_build_fails_if_all_prompts_fail_and_keeps_the_graph(run: Run, kitchen: Path):
    with serve(refuse(401, "bad key")) as server:
        grounder = f"llm-B:openai:x@{server.url}/v1"
        done = run("build", kitchen, "--grounder", grounder, "-o", "g.ttl")
        many = run("build", kitchen, kitchen.parent / "none.usda", "--grounder", grounder, "-o", "out", "--json")
        cascade = run("build", kitchen, "--grounder", grounder, "--cascade", "1", "-o", "c.ttl")
    for one in (done, many, cascade):
        assert one.code == 2
        assert "status 401" in one.err
    assert done.err.splitlines()[-1].startswith(f"usd2kg: {grounder}: {REFUSED}")
    assert Path("g.ttl").read_text().count("primPath") > 2
    assert Path("out/scene.ttl").is_file()
    # The lexical grounder's classes remain.
    assert "Cup" in Path("c.ttl").read_text()


def test_batch_reports_a_scene_whose_prompts_all_failed(run: Run, kitchen: Path):
    with serve(refuse(401, "bad key")) as server:
        done = run("batch", kitchen, "-o", "out", "--workers", "1", "--grounder", f"llm-B:openai:x@{server.url}/v1")
    assert done.code == 1
    assert "the model completed none of 2 prompts" in done.err


def test_one_completion_is_enough(run: Run, kitchen: Path):
    with serve(openai_reply(cup()), refuse(401, "bad key")) as server:
        done = run("ground", kitchen, "--grounder", f"llm-B:openai:x@{server.url}/v1", "--concurrency", "1")
    assert done.code == 0
    assert "1 prompt failed" in done.err
    assert re.search(r"^1 prompt without a completion \(model 'openai:x@.*status 401: bad key", done.err, re.M)
