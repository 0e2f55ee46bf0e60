"""Requests to Azure OpenAI, and what it answers."""

from decimal import Decimal

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.connections import KEYS, complete, fail
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Finish, Usage
from usd2kg.grounding.llm.prices import find_tariff

MODEL = "azure:gpt-4o"
BLOCKED = servers.Reply(
    {"error": {"code": "content_filter", "message": "blocked", "innererror": {"content_filter_result": {}}}}, 400
)


def test_a_dated_version_is_sent_to_the_deployment():
    environment = KEYS | {"OPENAI_API_VERSION": "2024-10-21"}

    _, (received,) = complete(MODEL, servers.openai_reply("{}"), environment=environment)

    assert received.path == "/openai/deployments/gpt-4o/chat/completions?api-version=2024-10-21"
    assert received.headers["api-key"] == "azure-secret-1"
    assert (received.body["temperature"], received.body["max_completion_tokens"]) == (0.5, 4000)
    form = received.body["response_format"]["json_schema"]
    assert (form["strict"], form["schema"]["properties"]["class"]["enum"]) == (True, ["Knife", "Cup"])
    assert received.body["logprobs"] is True


def test_without_a_version_the_deployment_is_the_model_of_the_undated_api():
    completion, (received,) = complete(MODEL, servers.openai_reply('{"class": "Cup"}', finish="length"))

    assert received.path == "/openai/v1/chat/completions"
    assert received.body["model"] == "gpt-4o"
    assert (completion.text, completion.finish) == ('{"class": "Cup"}', Finish.LENGTH)
    assert completion.usage == Usage(100, 60, 7)


def test_a_prompt_that_the_filter_blocks_has_no_text():
    completion, received = complete(MODEL, BLOCKED)

    assert (completion.text, len(received)) == ("", 1)


def test_a_deployment_that_does_not_exist():
    text, attempts, _ = fail(MODEL, servers.refuse(404, "DeploymentNotFound"), max_retries=3)

    assert attempts == 1
    assert "status 404: DeploymentNotFound; expected a model that the server knows" in text


@pytest.mark.parametrize(
    ("environment", "problem"),
    [
        ({}, "azure: no endpoint in the environment; expected one like https://NAME.openai.azure.com in AZURE_OPENAI"),
        ({"AZURE_OPENAI_ENDPOINT": "name.azure.com"}, "AZURE_OPENAI_ENDPOINT: no host and port in its URL"),
        ({"AZURE_OPENAI_ENDPOINT": "https://me:pw@h"}, "AZURE_OPENAI_ENDPOINT: its URL contains a user"),
        ({"AZURE_OPENAI_ENDPOINT": "https://h"}, "model 'azure:gpt-4o': no key in the environment; expected one, set"),
    ],
)
def test_reports_what_is_missing_in_the_environment(environment: dict[str, str], problem: str):
    with pytest.raises(GroundingError, match=problem) as caught:
        make_client(MODEL, environment=environment)

    assert "pw" not in str(caught.value)


def test_rejects_a_url_in_the_model_string():
    with pytest.raises(GroundingError, match=r"model 'azure:m@…': a URL in the model string; expected it in the env"):
        make_client("azure:m@https://h/v1", environment=KEYS)


def test_a_deployment_called_like_its_model_has_its_price():
    tariff = find_tariff(MODEL)

    assert tariff is not None
    assert tariff(Usage(1_000_000)) == Decimal("2.5")
    assert find_tariff("azure:my-deployment") is None
