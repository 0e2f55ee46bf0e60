"""The graph of a studio is that of a build with the same decisions."""

from contextlib import closing
from pathlib import Path

from usd2kg.grounding import read_decisions
from usd2kg.pipeline import build
from usd2kg.studio import ProjectSources, open_project
from usd2kg.studio.open_session import open_session
from usd2kg.studio.verdicts import Verdict, VerdictKind


def test_relations_follow_the_decisions(stage: Path, tmp_path: Path):
    with open_project(tmp_path / "p", ProjectSources(stage)) as project, closing(open_session(project)) as session:
        kinds = {(r.kind, r.target, r.anchor) for r in session.graph().relations}
        assert ("on", "/Kitchen/Cup_2", "/Kitchen/Table") in kinds
        # Nothing stands on a wall.
        wall = Verdict(VerdictKind.CLASS, session.tbox.resolve("Wall"))
        session.decide({"/Kitchen/Table": wall}, "Ann", 0)
        graph = session.graph()
        kinds = {(r.kind, r.target, r.anchor) for r in graph.relations}
        assert ("on", "/Kitchen/Cup_2", "/Kitchen/Table") not in kinds
        assert session.relations_of("/Kitchen/Cup_2") == [
            r for r in graph.relations if "/Kitchen/Cup_2" in (r.target, r.anchor)
        ]
        decisions = read_decisions(project.journal, session.tbox)
        built = build(stage, decisions=decisions)
        assert graph.relations == built.graph.relations
        assert graph.classes == built.graph.classes
        session.undo("Ann")
        assert ("on", "/Kitchen/Cup_2", "/Kitchen/Table") in {
            (r.kind, r.target, r.anchor) for r in session.graph().relations
        }
