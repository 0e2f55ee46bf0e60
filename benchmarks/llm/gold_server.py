"""GoldServer: a local server with OpenAI's protocol that knows the gold labels of a scene and errs in a fixed way.

The share of right answers depends on what the prompt shows, roughly as in the study; the errors are of all classes that
the study names. Equal prompts have equal answers. It shows what a run and its report look like, not how a model does.
"""

import hashlib
import json
import re
from collections.abc import Iterator, Sequence

from tests.grounding.llm.servers import FakeServer, Received, Reply, openai_events, pieces
from usd2kg.evaluation import GoldLabel
from usd2kg.grounding import NamingRegime, view_objects
from usd2kg.grounding.llm.class_lists import name_classes
from usd2kg.grounding.llm.prompt_options import PromptOptions
from usd2kg.grounding.llm.prompts import build_requests
from usd2kg.ontology import TBox
from usd2kg.scene import Scene

__all__ = ["GoldServer"]

_ROW = re.compile(r"^object (\d+)\n(.*?)(?=^object |^</objects>)", re.S | re.M)
_NAME = re.compile(r'^name: ("(?:[^"\\]|\\.)*")', re.M)
_PLACE = re.compile(r"^position .*", re.M)
_BOX = re.compile(r"^box .*", re.M)
_RIGHT = {NamingRegime.SEMANTIC: 0.95, NamingRegime.ABBREVIATED: 0.8, NamingRegime.OPAQUE: 0.45}
"""Share of right answers by the regime of the name, with context."""
_RIGHT_WITHOUT = 0.06
"""Share of right answers for an opaque name without context."""
_LOOP = "la la la " * 200
_UNKNOWN = "Thingamajig"


class GoldServer(FakeServer):
    """Answers each object of a prompt, found by its name under any naming regime."""

    def __init__(self, scene: Scene, gold: Sequence[GoldLabel], tbox: TBox) -> None:
        super().__init__(Reply())
        names = name_classes(tbox)
        self._tbox, self._shown = tbox, {iri: names[iri] for iri in tbox.by_iri}
        targets = {label.prim_path: label.target for label in gold}
        self._targets: dict[str, tuple[str, NamingRegime]] = {}
        for regime in _RIGHT:
            views = [(obj.prim_path, view) for obj, view in view_objects(scene, regime) if obj.prim_path in targets]
            batches = build_requests([view for _, view in views], tbox, PromptOptions())
            for (path, _), batch in zip(views, batches, strict=True):
                for key in _keys(batch.request.user):
                    self._targets.setdefault(key, (targets[path], regime))

    def _take(self, received: Received) -> Reply:
        with self._lock:
            self.received.append(received)
        texts = [str(message["content"]) for message in received.body["messages"]]
        answers = {number: self._answer(row) for number, row in _ROW.findall(texts[-1])}
        text = _LOOP if _LOOP in answers.values() else json.dumps({n: {"class": name} for n, name in answers.items()})
        tokens = {"prompt_tokens": sum(map(len, texts)) // 4, "completion_tokens": len(text) // 4}
        usage = {**tokens, "total_tokens": sum(tokens.values())}
        return Reply(events=lambda: openai_events(pieces(text, 200), usage=usage))

    def _answer(self, row: str) -> str:
        """Return the name of a class, an unknown name, or a loop; the same for the same row."""
        known = (self._targets[key] for key in _keys(row) if key in self._targets)
        target, regime = next(known, (None, NamingRegime.OPAQUE))
        has_context = "\n" in row.strip()
        is_informed = has_context or regime is not NamingRegime.OPAQUE
        share = _RIGHT[regime if _NAME.search(row) else NamingRegime.OPAQUE] if is_informed else _RIGHT_WITHOUT
        draw = int(hashlib.sha256(row.encode()).hexdigest()[:8], 16) / 16**8
        if target is not None and draw < share:
            return self._shown[target]
        return self._err(target or self._tbox.roots[0], (draw - share) / (1 - share))

    def _err(self, target: str, draw: float) -> str:
        parents = self._tbox.by_iri[target].parents
        if draw > 0.97:
            return _LOOP
        if draw > 0.92:
            return _UNKNOWN
        if not parents:
            return self._shown[self._tbox.roots[0]]
        siblings = [iri for iri in self._tbox.children[parents[0]] if iri != target]
        return self._shown[siblings[0] if draw > 0.5 and siblings else parents[0]]


def _keys(text: str) -> Iterator[str]:
    """Yield the lines of a row that tell objects apart: name, position, box."""
    found = (pattern.search(text) for pattern in (_NAME, _PLACE, _BOX))
    yield from (match[0] for match in found if match is not None)
