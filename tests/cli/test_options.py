"""Help texts: every parameter has one, and an option has the same one in all commands."""

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import fields, replace
from typing import Any

import typer

from usd2kg.cli.app import make_app
from usd2kg.cli.evaluate.matrix import MatrixModelOptions
from usd2kg.cli.options.model import ModelOptions, RequestOptions
from usd2kg.graph.formats.serialize import GRAPH_FORMATS
from usd2kg.graph.rdf_document import RDF_FORMATS
from usd2kg.relations import ALL_KINDS, DEFAULT_KINDS, VIEWPOINT_KINDS

OF_ONE_COMMAND = {
    "--all": "diff shows changes, the others findings",
    "--base": "diff takes the namespace of the other graph",
    "--force": "eval annotate overwrites labels, eval fetch files that differ",
    "--format": "ground writes mappings, diff writes changes",
    "--gold": "eval reproduce takes it for --study",
    "--into": "ontology fetch names the folder after the ontology",
    "--memory-limit": "of a scene in batch, of a query in serve",
    "--output": "each command writes another kind of file",
    "--profile": "build has auto, ontology shapes has not",
    "--refresh": "ground renews completions, eval reproduce renews results",
    "--relation-kinds": "build finds, diff compares them",
    "--time-limit": "of a scene in batch, of a query in serve",
    "--workers": "scenes in batch, queries in serve",
    "--scene": "a file for eval reproduce, else a graph: store load names a new one, the others choose one",
}
"""Option → why its meaning differs between commands."""


def parameters(command: Any, names: tuple[str, ...] = ()) -> Iterator[tuple[str, Any]]:
    for parameter in command.params:
        yield " ".join(names), parameter
    for name, subcommand in getattr(command, "commands", {}).items():
        yield from parameters(subcommand, (*names, name))


def test_every_parameter_has_a_help_text():
    found = list(parameters(typer.main.get_command(make_app())))
    assert len(found) > 100
    assert [(command, p.name) for command, p in found if not getattr(p, "help", None)] == []


def test_help_texts_name_all_relations_and_formats():
    # The help texts are literals: the modules of these tables load numpy and OWL parsers, which no other command needs.
    help_of = {(command, p.name): p.help for command, p in parameters(typer.main.get_command(make_app()))}
    kinds = words_of(help_of["build", "relation_kinds"])
    assert set(ALL_KINDS) <= kinds
    assert set(ALL_KINDS) - set(VIEWPOINT_KINDS) - set(DEFAULT_KINDS) == {"between"}, (
        "the only one not found by default"
    )
    endings = {ending.removeprefix(".") for ending in GRAPH_FORMATS}
    for command, option in (("batch", "file_format"), ("build", "output"), ("graph convert", "output")):
        assert endings <= words_of(help_of[command, option]), command
    assert {ending.removeprefix(".") for ending in RDF_FORMATS} <= words_of(help_of["graph convert", "graph"])


def test_errors_name_the_options_of_models_as_they_are_spelled():
    spellings = {p.name: p.opts for _, p in parameters(typer.main.get_command(make_app()))}
    for bundle in (ModelOptions, RequestOptions, MatrixModelOptions):
        for field in fields(bundle):
            if field.name != "requests":
                changed = list(replace(bundle(), **{field.name: object()}).changed_options())
                assert set(changed) & set(spellings[field.name]) == set(changed) != set()
    nested = replace(ModelOptions(), requests=RequestOptions(replay=True), samples=2)
    assert list(nested.changed_options()) == ["--samples", "--replay"]
    assert list(ModelOptions().changed_options()) == []


def words_of(text: str) -> set[str]:
    return set(re.findall(r"[\w-]+", text))


def test_an_option_has_the_same_help_text_in_all_commands():
    texts = defaultdict(set)
    for _, parameter in parameters(typer.main.get_command(make_app())):
        for name in parameter.opts:
            if name.startswith("--"):
                texts[name].add(parameter.help)
    assert {name for name, found in texts.items() if len(found) > 1} == OF_ONE_COMMAND.keys()
