"""Token estimates against values calculated by hand."""

import json
import struct
from dataclasses import replace
from decimal import Decimal

import pytest

from tests.grounding.records import make_class, make_tbox
from usd2kg.grounding import ObjectView
from usd2kg.grounding.llm.completion import Request, Usage
from usd2kg.grounding.llm.estimates import estimate_input, estimate_run, estimate_usage
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompt_text import estimate_tokens
from usd2kg.grounding.llm.prompts import build_requests

TBOX = make_tbox(make_class("Cup"), make_class("Plate"))
"""Class names of three and five letters: four on average."""


def test_estimates_one_row_per_object():
    views = [ObjectView(name="a"), ObjectView(name="b")]
    [batch] = build_requests(views, TBOX, PromptOptions(objects_per_prompt=2))

    usage = estimate_usage(batch.request)

    answer = json.dumps({"1": {"class": "Bowl"}, "2": {"class": "Vase"}})
    assert len(answer) == 48
    sent = estimate_tokens(batch.request.system + batch.request.user)
    assert usage == Usage(sent, 0, 12, estimated_tokens=sent + 12)


def test_includes_requested_reasoning():
    options = PromptOptions(strategy=Strategy.CHAIN_OF_THOUGHT, objects_per_prompt=2)
    [batch] = build_requests([ObjectView(name="a"), ObjectView(name="b")], TBOX, options)

    assert estimate_usage(batch.request).output_tokens == 12 + 2 * 120


@pytest.mark.parametrize(("width", "height", "tokens"), [(750, 1, 1), (1, 751, 2), (512, 512, 350), (0, 0, 0)])
def test_estimates_images_by_their_pixels(width: int, height: int, tokens: int):
    png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", width, height) + b"and so on"
    request = Request("1234", "5678", {})

    assert estimate_input(request) == 2
    assert estimate_input(replace(request, images=(png, png))) == 2 + 2 * tokens
    assert estimate_input(replace(request, images=(b"no picture", b""))) == 2


def test_adds_up_a_run_with_its_price():
    batches = build_requests([ObjectView(name="a"), ObjectView(name="b")], TBOX, PromptOptions())
    requests = [batch.request for batch in batches]

    usage, price = estimate_run(requests, lambda used: Decimal(used.output_tokens))

    assert usage == estimate_usage(requests[0]) + estimate_usage(requests[1])
    assert price == f"about ${usage.output_tokens}.00"
    assert estimate_run(requests, None) == (usage, "price unknown")
