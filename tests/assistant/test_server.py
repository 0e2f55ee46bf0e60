"""The MCP server over stdio, called by a real client on the demo kitchen."""

import asyncio
import json
import os
import sys
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest
from mcp import Client, StdioServerParameters, stdio_client

from tests.kitchen import kitchen_graph
from usd2kg import write_graph
from usd2kg.demo import demo_scene


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The graph of the demo kitchen."""
    path = tmp_path_factory.mktemp("mcp") / "kitchen.ttl"
    write_graph(kitchen_graph(), path)
    return path


def talk_to(arguments: list[str], conversation: Callable[[Client], Awaitable[Any]]) -> Any:
    """Run `usd2kg mcp` as a subprocess and return the result of a conversation with it."""
    command = StdioServerParameters(
        command=sys.executable, args=["-m", "usd2kg", "mcp", *arguments], env=dict(os.environ)
    )

    async def run() -> Any:
        async with Client(stdio_client(command)) as client:
            return await conversation(client)

    return asyncio.run(run())


async def call(client: Client, tool: str, **arguments: Any) -> Any:
    result = await client.call_tool(tool, arguments)
    text = result.content[0].text
    return text if result.is_error else json.loads(text)


def test_each_tool_answers(kitchen: Path):
    async def conversation(client: Client) -> None:
        tools = {tool.name: tool for tool in (await client.list_tools()).tools}
        assert set(tools) == {"objects", "look_up", "ask", "questions", "ready_question", "sparql"}
        assert all(tool.annotations.read_only_hint for tool in tools.values())

        listed = await call(client, "objects")
        assert (listed["count"], len(listed["objects"])) == (294, 100)
        rest = await call(client, "objects", start=200)
        assert len(rest["objects"]) == 94
        assert (await call(client, "objects", class_name="table"))["objects"][0]["class"] in {"table", "dining table"}

        table = (await call(client, "look_up", thing="diningTable"))["objects"][0]
        assert table["size_m"] == pytest.approx([1.8, 0.9, 0.750744])
        assert "WineBottle_open" in table["on_it"]
        assert table["stands_on"] == ["rug"]

        asked = await call(client, "ask", question="How many forks are on the dining table?")
        assert (asked["understood"], asked["count"]) == ("number of forks on dining table", 6)

        questions = {question["id"]: question for question in (await call(client, "questions"))["questions"]}
        assert questions["contents"]["parameters"] == {"thing": "OBJECT"}
        contents = await call(client, "ready_question", id="contents", parameters={"thing": "Fridge_01"})
        assert "butterDish" in {row["object"] for row in contents["rows"]}

        counted = await call(client, "sparql", query="SELECT (COUNT(*) AS ?n) { ?o u2k:primPath ?p }")
        assert counted == {"rows": [{"n": 295}], "count": 1}

    talk_to([str(kitchen)], conversation)


def test_errors_are_one_line_and_the_graph_is_unchanged(kitchen: Path):
    before = kitchen.read_bytes()

    async def conversation(client: Client) -> None:
        assert "'flurbl' is not a word" in await call(client, "look_up", thing="flurbl")
        assert "is not understood" in await call(client, "ask", question="sing me a song")
        assert "question 'nope' is unknown" in await call(client, "ready_question", id="nope")
        assert "begins with DELETE" in await call(client, "sparql", query="DELETE WHERE { ?s ?p ?o }")
        service = "SELECT * { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }"
        assert "SERVICE contacts another server" in await call(client, "sparql", query=service)
        endless = "SELECT (COUNT(*) AS ?n) { ?a ?b ?c . ?d ?e ?f . ?g ?h ?i }"
        assert "query: stopped after 2 s; simplify it" in await call(client, "sparql", query=endless)
        assert (await call(client, "objects"))["count"] == 294

    talk_to([str(kitchen), "--time-limit", "2"], conversation)
    assert kitchen.read_bytes() == before


def test_shows_a_picture_if_the_stage_is_given(kitchen: Path):
    async def conversation(client: Client) -> Any:
        return await client.call_tool("show", {"thing": "toaster"})

    result = talk_to([str(kitchen), "--stage", str(demo_scene())], conversation)
    assert not result.is_error
    assert (result.content[0].type, result.content[0].mime_type) == ("image", "image/png")
    assert len(result.content[0].data) > 1000
