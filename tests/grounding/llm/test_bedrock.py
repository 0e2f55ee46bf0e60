"""Requests to Amazon Bedrock's Converse API, and what it answers."""

import re
import sys
from dataclasses import replace
from decimal import Decimal

import pytest
from botocore.awsrequest import AWSPreparedRequest
from botocore.exceptions import ConnectionClosedError

from tests.grounding.llm import servers
from tests.grounding.llm.bedrock_server import converse_events, converse_reply, frame
from tests.grounding.llm.connections import KEYS, REQUEST, complete, fail
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Finish, Usage
from usd2kg.grounding.llm.prices import find_tariff

MODEL = "bedrock:us.anthropic.claude-haiku-4-5-20251001-v1:0"
NO_KEY = {name: value for name, value in KEYS.items() if not name.startswith("AWS_")}


def test_requests_are_signed_with_the_access_key():
    environment = KEYS | {"AWS_SESSION_TOKEN": "session-1"}

    completion, (received,) = complete(MODEL, converse_reply('{"class": "Cup"}'), environment=environment)

    assert received.path == "/model/us.anthropic.claude-haiku-4-5-20251001-v1%3A0/converse-stream"
    signature = r"AWS4-HMAC-SHA256 Credential=aws-id-1/\d{8}/eu-west-1/bedrock/aws4_request, SignedHeaders=\S+, .+"
    assert re.fullmatch(signature, received.headers["authorization"])
    assert received.headers["x-amz-security-token"] == "session-1"
    assert (completion.text, completion.finish) == ('{"class": "Cup"}', Finish.STOP)
    assert completion.usage == Usage(40 + 60, 60, 7)


def test_an_api_key_is_a_bearer_token():
    """Only over https, so the request is read before it is sent."""
    environment = NO_KEY | {"AWS_BEARER_TOKEN_BEDROCK": "bearer-secret-1", "AWS_REGION": "us-east-1"}
    sent: list[tuple[str, bytes]] = []

    def stop(request: AWSPreparedRequest, **_: object) -> None:
        sent.append((request.url, request.headers["Authorization"]))
        raise ConnectionClosedError(endpoint_url=request.url)

    with make_client(MODEL, environment=environment, max_retries=0) as client:
        client._provider_model.client.meta.events.register("before-send.bedrock-runtime", stop)
        with pytest.raises(GroundingError, match="no readable answer"):
            client.complete(REQUEST)

    host = "https://bedrock-runtime.us-east-1.amazonaws.com"
    path = "/model/us.anthropic.claude-haiku-4-5-20251001-v1%3A0/converse-stream"
    assert sent == [(host + path, b"Bearer bearer-secret-1")]


def test_an_api_key_is_not_sent_unencrypted():
    environment = NO_KEY | {"AWS_BEARER_TOKEN_BEDROCK": "bearer-secret-1"}

    with pytest.raises(GroundingError, match="is not encrypted; expected https for the key in AWS_BEARER_TOKEN"):
        complete(MODEL, converse_reply("{}"), environment=environment)


def test_a_server_on_this_machine_needs_no_key():
    completion, _ = complete(MODEL, converse_reply("{}"), environment=NO_KEY)

    assert completion.text == "{}"


def test_requests_the_schema_and_caches_the_system_prompt():
    _, (received,) = complete(MODEL, converse_reply("{}"))

    assert received.body["system"] == [{"text": "the classes"}, {"cachePoint": {"type": "default"}}]
    assert received.body["messages"] == [{"role": "user", "content": [{"text": "the objects"}]}]
    assert received.body["inferenceConfig"] == {"maxTokens": 4000, "temperature": 0.5}
    form = received.body["outputConfig"]["textFormat"]
    assert form["type"] == "json_schema"
    assert '"enum":["Knife","Cup"]' in form["structure"]["jsonSchema"]["schema"].replace(" ", "")


def test_describes_the_schema_to_models_without_support():
    _, (received,) = complete("bedrock:meta.llama3-1-8b-instruct-v1:0", converse_reply("{}"))

    assert "outputConfig" not in received.body
    assert '"Knife"' in "".join(part.get("text", "") for part in received.body["system"])


def test_a_thinking_model_gets_no_temperature():
    _, (received,) = complete(MODEL, converse_reply("{}"), request=replace(REQUEST, is_thinking=True))

    assert received.body["inferenceConfig"] == {"maxTokens": 4000}
    assert received.body["additionalModelRequestFields"]["thinking"]["type"] == "enabled"


@pytest.mark.parametrize("is_streamed", [True, False])
def test_a_truncated_completion(is_streamed: bool):
    reply = converse_reply('{"class": "Cu', finish="max_tokens")
    # A server that refuses to stream is asked again without.
    replies = [reply] if is_streamed else [servers.refuse(400, "no stream"), replace(reply, events=None)]

    completion, received = complete(MODEL, *replies)

    assert (completion.text, completion.finish) == ('{"class": "Cu', Finish.LENGTH)
    assert received[-1].path.endswith("/converse-stream" if is_streamed else "/converse")


def test_a_refusal_has_no_text():
    refusal = replace(converse_reply(""), events=lambda: converse_events([], finish="guardrail_intervened"))

    completion, received = complete(MODEL, refusal)

    assert (completion.text, len(received)) == ("", 1)


@pytest.mark.parametrize(
    ("kind", "is_retried"),
    [("throttlingException", True), ("modelStreamErrorException", True), ("validationException", False)],
)
def test_an_error_inside_a_stream(kind: str, is_retried: bool):
    error = frame(kind, {"message": "something happened"}, is_error=True)
    reply = replace(converse_reply(""), events=lambda: [frame("messageStart", {"role": "assistant"}), error])

    text, attempts, _ = fail(MODEL, reply, max_retries=1, sleep=lambda _: None)

    assert attempts == (2 if is_retried else 1)
    assert "something happened; " in text


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"AWS_REGION": ""}, "bedrock: no region in the environment; expected one like us-east-1 in AWS_REGION or"),
        ({"AWS_REGION": "evil.example/"}, "bedrock: no region in the environment"),
        ({"AWS_SECRET_ACCESS_KEY": ""}, f"model '{MODEL}': AWS_ACCESS_KEY_ID has no secret; expected one, set AWS_S"),
        ({"AWS_ACCESS_KEY_ID": ""}, f"model '{MODEL}': no key in the environment; expected one, set AWS_BEARER_TOKEN"),
    ],
)
def test_reports_what_is_missing_in_the_environment(change: dict[str, str], problem: str):
    with pytest.raises(GroundingError, match=problem):
        make_client(MODEL, environment=KEYS | {"AWS_REGION": "eu-west-1"} | change)


def test_names_the_missing_extra(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "boto3", None)

    with pytest.raises(GroundingError, match=r"boto3 is not installed; .* pip install 'usd2kg\[bedrock\]'"):
        make_client(MODEL, environment=KEYS | {"AWS_REGION": "eu-west-1"})


def test_has_the_price_of_its_list():
    tariff = find_tariff("bedrock:amazon.nova-lite-v1:0")

    assert tariff is not None
    assert tariff(Usage(1_000_000)) == Decimal("0.06")
