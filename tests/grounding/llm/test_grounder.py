"""LLMGrounder with fake models."""

import json
import math
import re
import signal
import threading
import time
from collections.abc import Callable
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

from tests.grounding.records import make_object, make_scene
from usd2kg.errors import GroundingError
from usd2kg.grounding import NamingRegime, ObjectView, Status, ground
from usd2kg.grounding.llm.answers import Defect
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Client, Completion, Finish, Request, Usage
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.grouping import group_similar_views
from usd2kg.grounding.llm.metered_client import Budget, MeteredClient, Spending
from usd2kg.grounding.llm.prices import Tariff, parse_price
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompts import ObjectPictures
from usd2kg.ontology import TBox
from usd2kg.scene import Box, Scene

Respond = Callable[[Request], str]


class Model:
    """A fake model that records its requests."""

    model = "test:model"

    def __init__(self, respond: Respond, *, finish: Finish = Finish.STOP, probability: float | None = None) -> None:
        """Create a model; with `probability`, each character of its text is a token of this probability."""
        self.respond, self.finish, self.probability = respond, finish, probability
        self.requests: list[Request] = []
        self.lock = threading.Lock()

    def complete(self, request: Request) -> Completion:
        with self.lock:
            self.requests.append(request)
        text = self.respond(request)
        tokens = tuple((letter, math.log(self.probability)) for letter in text) if self.probability else ()
        return Completion(text, self.finish, Usage(100, 40, 10), tokens)


def numbers(request: Request) -> list[str]:
    """Return the numbers of the objects in a prompt."""
    return list(request.schema["properties"])


def always(name: str) -> Respond:
    return lambda request: json.dumps({number: {"class": name} for number in numbers(request)})


def make_grounder(
    model: Client,
    options: PromptOptions,
    *,
    cache: CompletionCache | None = None,
    is_refreshed: bool = False,
    token_budget: int | None = None,
    tariff: Tariff | None = None,
    budget: Decimal | None = None,
    **form: Any,
) -> LLMGrounder:
    """Return a grounder with the model."""
    limits = Budget(token_budget, budget)
    asker = MeteredClient(model, cache=cache, is_refreshed=is_refreshed, budget=limits, tariff=tariff)
    return LLMGrounder(asker, options, **form)


def kitchen(*names: str) -> Scene:
    return make_scene(*(make_object(f"/World/{name}", box=Box((0, 0, 0), (0.1, 0.1, 0.1))) for name in names))


def answers(scene: Scene, tbox: TBox, grounder: LLMGrounder) -> list[str | None]:
    found = ground(scene, tbox, grounder).predictions
    return [p.class_iri.rpartition("#")[2] if p.class_iri else None for p in found]


def test_grounds_each_object_by_the_answer(home_tbox: TBox):
    def respond(request: Request) -> str:
        return json.dumps({n: {"class": "Bowl" if "bowl" in request.user else "Cup"} for n in numbers(request)})

    model = Model(respond)
    grounder = make_grounder(model, PromptOptions(strategy=Strategy.NAME_ONLY))
    assert answers(kitchen("mug", "bowl"), home_tbox, grounder) == ["Cup", "Bowl"]
    assert len(model.requests) == grounder.report.completions == 2
    assert grounder.report.usage == Usage(200, 80, 20)


def test_sends_several_objects_in_one_prompt(home_tbox: TBox):
    model = Model(always("Cup"))
    grounder = make_grounder(model, PromptOptions(objects_per_prompt=10))
    assert answers(kitchen(*(f"mug{letter}" for letter in "abcdefgh")), home_tbox, grounder) == ["Cup"] * 8
    assert len(model.requests) == 1


def test_prompts_once_for_objects_that_differ_in_a_number(home_tbox: TBox):
    model = Model(always("Cup"))
    assert answers(kitchen("mug_1", "mug_2", "mug_3"), home_tbox, make_grounder(model, PromptOptions())) == ["Cup"] * 3
    assert len(model.requests) == 1
    each = Model(always("Cup"))
    answers(kitchen("mug_1", "mug_2", "mug_3"), home_tbox, make_grounder(each, PromptOptions(), shares_answers=False))
    assert len(each.requests) == 3


def test_masked_objects_do_not_share_an_answer(home_tbox: TBox):
    model = Model(always("Cup"))
    ground(kitchen("mug", "oven"), home_tbox, make_grounder(model, PromptOptions()), regime=NamingRegime.OPAQUE)
    assert len(model.requests) == 2


def test_objects_of_different_size_share_an_answer_by_name_only():
    views = [ObjectView(name="box_1", size=(1, 1, 1)), ObjectView(name="box_2", size=(2, 1, 1))]
    assert group_similar_views(views, PromptOptions(strategy=Strategy.NAME_ONLY)) == [[0, 1]]
    assert group_similar_views(views, PromptOptions(strategy=Strategy.CONTEXT)) == [[0], [1]]


def test_repairs_an_invented_class(home_tbox: TBox):
    prompts: list[str] = []

    def respond(request: Request) -> str:
        prompts.append(request.user)
        return json.dumps({n: {"class": "Cup" if len(prompts) > 1 else "Chalice"} for n in numbers(request)})

    grounder = make_grounder(Model(respond), PromptOptions())
    assert answers(kitchen("mug"), home_tbox, grounder) == ["Cup"]
    assert grounder.report.repairs == 1
    assert "Chalice" in prompts[1]


def test_reports_an_answer_that_stays_unreadable(home_tbox: TBox):
    grounder = make_grounder(Model(lambda _: "la " * 300, finish=Finish.LENGTH), PromptOptions())
    [prediction] = ground(kitchen("mug"), home_tbox, grounder).predictions
    assert (prediction.class_iri, prediction.confidence, prediction.status) == (None, None, Status.UNREADABLE)
    assert prediction.explanation
    assert grounder.report.degenerate == 2  # The answer and its repair.


def test_counts_the_objects_of_each_defect_of_final_answers(home_tbox: TBox):
    texts = {
        "mug": '{"1": {"class": "Chalice"}}',
        "bowl": "la " * 300,
        "fork": '{"1": {"class": null}}',
        "plate": '{"1": {"class": "Plate"}}',
    }
    model = Model(lambda request: next(text for name, text in texts.items() if f'name: "{name}"' in request.user))
    grounder = make_grounder(model, PromptOptions(strategy=Strategy.NAME_ONLY))
    assert answers(kitchen(*texts), home_tbox, grounder)[:3] == [None] * 3
    # A refusal is no defect, and the repair of the hallucination and of the loop repeat the same text.
    assert grounder.report.defects == {Defect.HALLUCINATED: 1, Defect.DEGENERATE: 1}


def test_a_repaired_answer_has_no_defect(home_tbox: TBox):
    def respond(request: Request) -> str:
        return always("Cup" if len(model.requests) > 1 else "Chalice")(request)

    model = Model(respond)
    grounder = make_grounder(model, PromptOptions())
    assert answers(kitchen("mug"), home_tbox, grounder) == ["Cup"]
    assert grounder.report.defects == {}


def test_a_restarted_report_is_empty_and_the_budget_counts_on(home_tbox: TBox, tmp_path: Path):
    price = parse_price("1000/0")  # A completion of 100 tokens costs 10 cents.
    with CompletionCache(tmp_path / "cache.sqlite") as cache:
        model = Model(always("Cup"))
        names = PromptOptions(strategy=Strategy.NAME_ONLY)
        grounder = make_grounder(model, names, cache=cache, workers=1, tariff=price, budget=Decimal("0.20"))
        assert answers(kitchen("mug", "bowl"), home_tbox, grounder) == ["Cup", "Cup"]
        assert (grounder.report.price, len(grounder.report.keys)) == (Decimal("0.2"), 2)
        grounder.restart_report()
        assert answers(kitchen("mug", "bowl", "fork"), home_tbox, grounder)[2] is None, "the budget is spent"
    report = grounder.report
    assert (report.completions, report.cached, report.price) == (0, 2, 0)
    assert (report.cached_usage, report.cached_price) == (Usage(200, 80, 20), Decimal("0.2"))
    assert len(report.keys) == 2


def test_clients_with_common_spending_share_a_budget(home_tbox: TBox):
    spending = Spending()
    clients = [MeteredClient(Model(always("Cup")), budget=Budget(tokens=110), spending=spending) for _ in range(2)]
    first, second = (LLMGrounder(client, PromptOptions()) for client in clients)
    assert answers(kitchen("mug"), home_tbox, first) == ["Cup"]
    [refused] = ground(kitchen("mug"), home_tbox, second).predictions
    assert refused.explanation == "not asked: 110 tokens are used of a budget of 110; raise --token-budget"


def test_repair_replaces_only_unreadable_answers(home_tbox: TBox):
    def respond(request: Request) -> str:
        is_repair = len(model.requests) > 1
        classes = {n: "Cup" if i or is_repair else "Chalice" for i, n in enumerate(numbers(request))}
        return json.dumps(
            {n: {"class": "Plate" if is_repair and i else name} for i, (n, name) in enumerate(classes.items())}
        )

    model = Model(respond)
    grounder = make_grounder(model, PromptOptions(objects_per_prompt=2))
    assert answers(kitchen("mug", "beaker"), home_tbox, grounder) == ["Cup", "Cup"]


def test_confidence_is_the_probability_of_the_class_name(home_tbox: TBox):
    model = Model(always("Cup"), probability=0.8)
    [known] = ground(kitchen("mug"), home_tbox, make_grounder(model, PromptOptions())).predictions
    assert known.confidence == pytest.approx(0.8**3)
    [unknown] = ground(kitchen("mug"), home_tbox, make_grounder(Model(always("Cup")), PromptOptions())).predictions
    assert unknown.confidence is None


def test_each_object_of_a_prompt_has_its_own_confidence(home_tbox: TBox):
    def respond(request: Request) -> str:
        return json.dumps({"1": {"class": "Cup"}, "2": {"class": "Spoon"}, "3": {"class": "Chalice"}, "4": None})

    grounder = make_grounder(Model(respond, probability=0.9), PromptOptions(objects_per_prompt=4))
    found = ground(kitchen("muga", "spoon", "cupa", "what"), home_tbox, grounder).predictions
    assert [p.confidence for p in found] == [pytest.approx(0.9**3), pytest.approx(0.9**5, abs=1e-4), None, None]


class TestFailures:
    @staticmethod
    def broken(request: Request) -> str:
        raise GroundingError("http://localhost:1: nobody answers")

    def test_stops_after_consecutive_failures(self, home_tbox: TBox):
        model = Model(self.broken)
        scene = kitchen(*(f"mug{letter}" for letter in "abcdefghij"))
        grounder = make_grounder(model, PromptOptions(), workers=1)
        predictions = ground(scene, home_tbox, grounder).predictions
        assert {p.status for p in predictions} == {Status.FAILED}
        assert predictions[0].explanation == "http://localhost:1: nobody answers"
        assert len(model.requests) == 3
        assert grounder.report.failed == 10

    def test_continues_after_a_single_failure(self, home_tbox: TBox):
        def respond(request: Request) -> str:
            return self.broken(request) if "bad" in request.user else always("Cup")(request)

        grounder = make_grounder(Model(respond), PromptOptions(strategy=Strategy.NAME_ONLY), workers=1)
        assert answers(kitchen("muga", "bad", "mugb"), home_tbox, grounder) == ["Cup", None, "Cup"]

    def test_stops_at_the_budget_and_keeps_earlier_answers(self, home_tbox: TBox):
        model = Model(always("Cup"))
        grounder = make_grounder(model, PromptOptions(), workers=1, token_budget=200)
        found = ground(kitchen("muga", "mugb", "mugc"), home_tbox, grounder).predictions
        assert [p.status for p in found] == [Status.GROUNDED, Status.GROUNDED, Status.FAILED]
        assert re.search(r"220 tokens are used of a budget of 200; raise --token-budget", found[2].explanation)


class TestPrice:
    """A completion of the fake model has 100 input tokens, 40 of them cached, and 10 output tokens."""

    TARIFF = staticmethod(parse_price("1000/5000"))
    """0.10 dollars for a prompt and 0.05 for its answer."""

    def test_sums_the_price_of_a_run(self, home_tbox: TBox):
        grounder = make_grounder(Model(always("Cup")), PromptOptions(), tariff=self.TARIFF)
        ground(kitchen("muga", "mugb"), home_tbox, grounder)
        assert grounder.report.price == Decimal("0.30")

    def test_includes_repairs(self, home_tbox: TBox):
        grounder = make_grounder(Model(always("Chalice")), PromptOptions(), tariff=self.TARIFF)
        ground(kitchen("mug"), home_tbox, grounder)
        assert grounder.report.price == Decimal("0.30")

    def test_cached_completions_are_free(self, home_tbox: TBox, tmp_path: Path):
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            prices = []
            for _ in range(2):
                grounder = make_grounder(Model(always("Cup")), PromptOptions(), cache=cache, tariff=self.TARIFF)
                ground(kitchen("mug"), home_tbox, grounder)
                prices.append(grounder.report.price)
        assert prices == [Decimal("0.15"), Decimal(0)]

    def test_is_none_without_a_tariff(self, home_tbox: TBox):
        grounder = make_grounder(Model(always("Cup")), PromptOptions())
        ground(kitchen("mug"), home_tbox, grounder)
        assert grounder.report.price is None

    def test_stops_at_the_budget_and_keeps_earlier_answers(self, home_tbox: TBox):
        grounder = make_grounder(
            Model(always("Cup")), PromptOptions(), workers=1, tariff=self.TARIFF, budget=Decimal("0.30")
        )
        found = ground(kitchen("muga", "mugb", "mugc"), home_tbox, grounder).predictions
        assert [p.status for p in found] == [Status.GROUNDED, Status.GROUNDED, Status.FAILED]
        assert found[2].explanation == "not asked: $0.3000 are spent of a budget of $0.3000; raise --budget"

    def test_a_zero_budget_uses_the_cache(self, home_tbox: TBox, tmp_path: Path):
        options = PromptOptions(strategy=Strategy.NAME_ONLY)
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            ground(kitchen("mug"), home_tbox, make_grounder(Model(always("Cup")), options, cache=cache))
            broke = make_grounder(Model(always("Bowl")), options, cache=cache, tariff=self.TARIFF, budget=Decimal(0))
            assert answers(kitchen("mug", "bowl"), home_tbox, broke) == ["Cup", None]

    def test_a_dollar_budget_requires_a_price(self):
        with pytest.raises(GroundingError, match=r"has no list price, which --budget requires; give one with --price"):
            make_grounder(Model(always("Cup")), PromptOptions(), budget=Decimal(1))


class TestCache:
    def test_a_rerun_sends_no_request(self, home_tbox: TBox, tmp_path: Path):
        model = Model(always("Cup"))
        scene = kitchen("muga", "mugb")
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            first = ground(scene, home_tbox, make_grounder(model, PromptOptions(), cache=cache))
            again = make_grounder(model, PromptOptions(), cache=cache)
            second = ground(scene, home_tbox, again)
        assert len(model.requests) == 2
        assert second.predictions == first.predictions
        assert (again.report.completions, again.report.cached, again.report.usage) == (0, 2, Usage())

    def test_refreshing_replaces_cached_completions(self, home_tbox: TBox, tmp_path: Path):
        scene = kitchen("mug")
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            ground(scene, home_tbox, make_grounder(Model(always("Cup")), PromptOptions(), cache=cache))
            refreshed = make_grounder(Model(always("Bowl")), PromptOptions(), cache=cache, is_refreshed=True)
            assert answers(scene, home_tbox, refreshed) == ["Bowl"]
            later = make_grounder(Model(always("Plate")), PromptOptions(), cache=cache)
            assert answers(scene, home_tbox, later) == ["Bowl"]

    def test_strategies_do_not_share_completions(self, home_tbox: TBox, tmp_path: Path):
        model = Model(always("Cup"))
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            for strategy in (Strategy.NAME_ONLY, Strategy.CONTEXT):
                ground(kitchen("mug"), home_tbox, make_grounder(model, PromptOptions(strategy=strategy), cache=cache))
        assert len(model.requests) == 2


def test_settings_contain_model_and_strategy():
    settings = make_grounder(Model(always("Cup")), PromptOptions(strategy=Strategy.CHAIN_OF_THOUGHT)).settings
    assert settings["model"] == "test:model"
    assert settings["strategy"] == "C"


class TestSamples:
    """Several completions of one prompt."""

    @staticmethod
    def respond_with(*names: str) -> Model:
        """Return a model that names another class for each sample."""
        return Model(
            lambda request: json.dumps({number: {"class": names[request.sample]} for number in numbers(request)})
        )

    def test_chooses_the_majority_class_with_its_share(self, home_tbox: TBox):
        model = self.respond_with("Bowl", "Cup", "Cup", "nonsense")
        grounder = make_grounder(model, PromptOptions(temperature=0.7), samples=4)
        (found,) = ground(kitchen("thing"), home_tbox, grounder).predictions
        assert found.class_iri == home_tbox.resolve("Cup")
        assert found.confidence == 0.5
        assert [(c.class_iri, c.score) for c in found.candidates] == [
            (home_tbox.resolve("Cup"), 0.5),
            (home_tbox.resolve("Bowl"), 0.25),
        ]
        assert sorted({request.sample for request in model.requests}) == [0, 1, 2, 3]

    def test_first_sample_distinguishes_repeated_runs(self, home_tbox: TBox, tmp_path: Path):
        model = self.respond_with("Bowl", "Cup", "Plate")
        with CompletionCache(tmp_path / "cache.sqlite") as cache:
            runs = [
                ground(
                    kitchen("thing"),
                    home_tbox,
                    make_grounder(model, PromptOptions(temperature=0.7), cache=cache, first_sample=number),
                )
                for number in (0, 1, 0)
            ]
        assert [run.predictions[0].class_iri for run in runs] == [
            home_tbox.resolve(name) for name in ("Bowl", "Cup", "Bowl")
        ]
        assert len(model.requests) == 2
        assert [run.settings.get("first_sample") for run in runs] == [None, "1", None]

    def test_is_unreadable_if_no_sample_has_a_class(self, home_tbox: TBox):
        grounder = make_grounder(self.respond_with("no", "nor this"), PromptOptions(temperature=0.7), samples=2)
        (found,) = ground(kitchen("thing"), home_tbox, grounder).predictions
        assert (found.class_iri, found.confidence, found.status) == (None, None, Status.UNREADABLE)

    @pytest.mark.parametrize(("samples", "temperature"), [(0, 0.7), (3, 0.0)])
    def test_rejects_invalid_numbers_of_samples(self, samples: int, temperature: float):
        with pytest.raises(GroundingError, match=f"{samples} samples"):
            make_grounder(self.respond_with("Cup"), PromptOptions(temperature=temperature), samples=samples)


def test_an_interrupt_keeps_earlier_answers(home_tbox: TBox):
    class Interrupted(Model):
        def complete(self, request: Request) -> Completion:
            if len(self.requests) == 2:
                signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
                time.sleep(0.3)
            return super().complete(request)

    updates: list[tuple[int, int]] = []
    names = [f"thing{letter}" for letter in "abcdef"]
    grounder = make_grounder(
        Interrupted(always("Cup")),
        PromptOptions(),
        workers=1,
        progress=lambda done, count: updates.append((done, count)),
    )
    found = ground(kitchen(*names), home_tbox, grounder).predictions
    assert grounder.report.is_interrupted
    lost = [p for p in found if p.class_iri is None]
    # Prompts in flight are completed.
    assert len(lost) == 3
    assert all(p.status is Status.FAILED and "interrupted" in p.explanation for p in lost)
    assert updates[-1] == (6, 6)


def test_requests_each_picture_once(home_tbox: TBox):
    model = Model(always("Cup"))
    paths: list[str] = []

    def pictures(path: str) -> ObjectPictures | None:
        paths.append(path)
        return ObjectPictures(b"png", b"png in place") if path.endswith("Mug") else None

    ground(kitchen("Mug", "Vase"), home_tbox, make_grounder(model, PromptOptions(), pictures=pictures))
    assert sorted(paths) == ["/World/Mug", "/World/Vase"]
    assert sorted(request.images for request in model.requests) == [(), (b"png", b"png in place")]


class TestByConcept:
    OPTIONS = PromptOptions(strategy=Strategy.BY_CONCEPT, is_tree=True, objects_per_prompt=40)

    def test_asks_once_for_objects_that_share_a_concept(self, home_tbox: TBox) -> None:
        def respond(request: Request) -> str:
            rows = re.findall(r'object (\d+)\nnames: "(\w+)', request.user)
            return json.dumps({number: {"class": word.capitalize()} for number, word in rows})

        model = Model(respond)
        names = [f"{noun}_{number}" for number in range(50) for noun in ("Fork", "SM_Bowl", "Knife")]
        found = ground(kitchen(*names), home_tbox, make_grounder(model, self.OPTIONS)).predictions
        assert len(model.requests) == 1
        assert numbers(model.requests[0]) == ["1", "2", "3"]
        nouns = {p.prim_path: next(w for w in ("Fork", "Bowl", "Knife") if w in p.prim_path) for p in found}
        assert {p.prim_path: home_tbox.by_iri[p.class_iri].local_name for p in found if p.class_iri} == nouns
        assert found[0].explanation == "answer of test:model about 50 objects that share a concept"

    def test_all_classes_are_offered_as_a_tree(self, home_tbox: TBox) -> None:
        model = Model(always("Fork"))
        ground(kitchen("Fork"), home_tbox, make_grounder(model, self.OPTIONS))
        assert len(model.requests[0].schema["properties"]["1"]["properties"]["class"]["enum"]) == len(home_tbox.classes)
        assert "  Fork" in model.requests[0].system

    def test_a_failure_is_that_of_all_objects_of_the_concept(self, home_tbox: TBox) -> None:
        def respond(request: Request) -> str:
            raise GroundingError("no server")

        found = ground(kitchen("Fork_1", "Fork_2"), home_tbox, make_grounder(Model(respond), self.OPTIONS)).predictions
        assert [(p.status, p.explanation) for p in found] == [(Status.FAILED, "no server")] * 2

    def test_masked_objects_are_asked_about_one_by_one(self, home_tbox: TBox) -> None:
        model = Model(always("Fork"))
        grounder = make_grounder(model, self.OPTIONS)
        ground(kitchen("Fork_1", "Fork_2"), home_tbox, grounder, regime=NamingRegime.OPAQUE)
        assert numbers(model.requests[0]) == ["1", "2"]
        assert "Fork" not in model.requests[0].user.partition("siblings")[0]
