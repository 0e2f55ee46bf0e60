"""Model strings and API keys."""

import sys

import pytest

from tests.grounding.llm.connections import KEYS
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import make_client


class TestModelStrings:
    @pytest.mark.parametrize("model", ["", "gemini", "google:", "gguf:/m.gguf", "openai:@http://h/v1", "openai:a b"])
    def test_rejects_malformed_model_strings(self, model: str):
        with pytest.raises(GroundingError, match="no known provider and name; expected google:NAME, anthropic:NAME or"):
            make_client(model, environment=KEYS)

    @pytest.mark.parametrize("url", ["http://", "http://:80/v1", "http://h:99999/v1", "http://[::1/v1"])
    def test_rejects_malformed_urls(self, url: str):
        with pytest.raises(GroundingError, match="model 'openai:m@…': no host and port in its URL"):
            make_client(f"openai:m@{url}", environment=KEYS)

    @pytest.mark.parametrize("url", ["127.0.0.1:8000/v1", "gpu.lab", "HTTP//h/v1", "me:hunter2x@h:80/v1", "ftp://h"])
    @pytest.mark.parametrize("provider", ["openai", "google", "anthropic", "azure"])
    def test_rejects_a_url_without_scheme_instead_of_asking_the_provider(self, provider: str, url: str):
        with pytest.raises(GroundingError) as caught:
            make_client(f"{provider}:m@{url}", environment=KEYS)

        assert str(caught.value) == (
            f"model '{provider}:m@…': no http:// or https:// after the @; expected google:NAME, anthropic:NAME or "
            "openai:NAME, optionally followed by @http://HOST:PORT/v1, azure:DEPLOYMENT or bedrock:MODEL"
        )

    @pytest.mark.parametrize("url", ["http://me:hunter2x@h/v1", "http://hunter2x@h/v1", "https://h/v1?key=hunter2x"])
    def test_rejects_credentials_in_a_url_without_showing_them(self, url: str):
        with pytest.raises(GroundingError, match="put the key into OPENAI_API_KEY") as caught:
            make_client(f"openai:m@{url}", environment=KEYS)

        assert "hunter2x" not in str(caught.value)

    @pytest.mark.parametrize(
        ("model", "variables"),
        [
            ("google:gemini-2.5-flash", "GOOGLE_API_KEY or GEMINI_API_KEY"),
            ("anthropic:claude-haiku-4-5", "ANTHROPIC_API_KEY"),
            ("openai:gpt-4o", "OPENAI_API_KEY"),
            ("openai:m@https://openrouter.ai/api/v1", "OPENAI_API_KEY"),
        ],
    )
    def test_reports_a_missing_key(self, model: str, variables: str):
        with pytest.raises(GroundingError) as caught:
            make_client(model, environment={"OPENAI_API_KEY": " "})

        assert str(caught.value) == f"model '{model}': no key in the environment; expected one, set {variables}"

    @pytest.mark.parametrize("key", ["schlüssel", "two\nlines"])
    def test_rejects_a_key_that_is_not_ascii_without_showing_it(self, key: str):
        with pytest.raises(GroundingError, match="the key contains characters that an HTTP header cannot") as caught:
            make_client("openai:gpt-4o", environment={"OPENAI_API_KEY": key})

        assert key not in str(caught.value)

    @pytest.mark.parametrize("host", ["localhost", "127.0.0.2", "[::1]", "gpu.localhost"])
    def test_loopback_urls_need_no_key(self, host: str):
        model = f"openai:org/m@v2@http://{host}:8000/v1"
        with make_client(model, environment={}) as client:
            assert client.model == model
            assert client.traffic.attempts == 0

    def test_missing_extra_names_its_install_command(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "pydantic_ai.models", None)

        with pytest.raises(GroundingError) as caught:
            make_client("openai:gpt-4o", environment=KEYS)

        assert str(caught.value) == (
            "model 'openai:gpt-4o': the module pydantic_ai.models is not installed; "
            "expected the extra `llm`, run pip install 'usd2kg[llm]'"
        )
