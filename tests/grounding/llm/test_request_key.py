"""The cache key of a request."""

from dataclasses import fields, replace
from types import MappingProxyType

from tests.grounding.llm.completions import MODEL, REQUEST, SCHEMA
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.serialization import request_key

CHANGES = {
    "system": "Classes: Fork, Cup",
    "user": "/World/cup_02",
    "schema": {"type": "object"},
    "max_tokens": 4097,
    "temperature": 0.7,
    "is_thinking": True,
    "sample": 1,
    "images": (b"a picture",),
}


def test_depends_on_every_field():
    assert list(CHANGES) == [field.name for field in fields(Request)]
    keys = [request_key(MODEL, replace(REQUEST, **{name: value})) for name, value in CHANGES.items()]
    keys += [request_key(MODEL, REQUEST), request_key(MODEL + "-lite", REQUEST)]
    assert len(set(keys)) == 10


def test_depends_on_the_order_of_properties_but_not_on_the_mapping_type():
    backwards = {**SCHEMA, "properties": dict(reversed(SCHEMA["properties"].items()))}
    assert backwards == SCHEMA
    assert request_key(MODEL, replace(REQUEST, schema=backwards)) != request_key(MODEL, REQUEST)
    frozen = MappingProxyType({**SCHEMA, "properties": MappingProxyType(SCHEMA["properties"])})
    assert request_key(MODEL, replace(REQUEST, schema=frozen, temperature=0)) == request_key(MODEL, REQUEST)


def test_is_stable_across_versions():
    # SHA-256 of this text by sha256sum.
    text = (
        '{"format":"usd2kg-request/1","model":"m","request":{"system":"Classes","user":"caf\\u00e9","schema":'
        '{"type":"object"},"most_tokens":4096,"temperature":0.0,"is_thinking":false,"sample":0}}'
    )
    assert text.isascii()
    key = "sha256:9bd2d222fef61ceb551ebf79f01a37c80c14fbc81ffde6b01e22e501892dfb02"
    assert request_key("m", Request("Classes", "café", {"type": "object"})) == key


def test_uses_the_digests_of_images():
    # SHA-256 of this text by sha256sum; the digest of the image is that of "cup".
    text = (
        '{"format":"usd2kg-request/1","model":"m","request":{"system":"Classes","user":"cup","schema":{},'
        '"most_tokens":4096,"temperature":0.0,"is_thinking":false,"sample":0,"images":'
        '["c6171781d65f3ccce1135e3c89850cfbaa7f332fd72a1f8f6a841fbcf7fd362a"]}}'
    )
    assert text.isascii()
    key = "sha256:bc39f1b6c7ef0321ff0ba1294b50ff1d40239f32f739a183c10f6c8f1e9a9214"
    assert request_key("m", Request("Classes", "cup", {}, images=(b"cup",))) == key


def test_depends_on_order_and_content_of_images():
    requests = [replace(REQUEST, images=images) for images in ((b"a",), (b"b",), (b"a", b"b"), (b"b", b"a"), (b"ab",))]
    assert len({request_key(MODEL, request) for request in requests}) == 5
