"""EmbeddingGrounder: the class whose name is most similar to the prim name by sentence embedding."""

from collections.abc import Mapping, Sequence

import numpy as np

from usd2kg.grounding.baselines.embedding.encoder import MiniLMEncoder, Vectors
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Candidate, Prediction, Status
from usd2kg.grounding.settings import BASELINES
from usd2kg.ontology import TBox
from usd2kg.words import split_identifier

__all__ = ["EmbeddingGrounder"]


class EmbeddingGrounder:
    """Compares names by their sentence embeddings. It always chooses a class, however dissimilar."""

    name = "embedding"
    is_calibrated = False

    def __init__(self, *, split_names: bool = True, threads: int = 1) -> None:
        """Load the model.

        Args:
            split_names: embed `CoffeeMug_01` and `CoffeeTable` as "coffee mug 01" and "coffee table" instead of
                as written.
            threads: number of threads for one name; 0 uses all cores.

        Raises:
            GroundingError: the extra `embedding` is not installed.
        """
        self._split_names = split_names
        self._encoder = MiniLMEncoder(threads)
        self._class_vectors: tuple[tuple[str, ...], Vectors] = ((), self._encoder.encode(()))

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that affect its predictions."""
        return {"model": self._encoder.versions, "split_names": str(self._split_names).lower()}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view), by the name alone."""
        classes = self._encode_classes(tbox)
        texts = dict.fromkeys(self._text(view.name) for _, view in views if view.name.strip())
        ranked = {text: self._rank(text, tbox, classes) for text in texts}
        return [self._predict(path, view, tbox, ranked) for path, view in views]

    def _encode_classes(self, tbox: TBox) -> Vectors:
        texts = tuple(self._text(cls.readable_name) for cls in tbox.classes)
        if self._class_vectors[0] != texts:
            self._class_vectors = (texts, self._encoder.encode(texts))
        return self._class_vectors[1]

    def _text(self, name: str) -> str:
        """Return the text to embed for a name; a name without letters and digits is unchanged."""
        words = split_identifier(name) if self._split_names else ()
        return " ".join(words).lower() or name

    def _rank(self, text: str, tbox: TBox, classes: Vectors) -> tuple[Candidate, ...]:
        (vector,) = self._encoder.encode([text])
        # Not `@`: BLAS may sum rows in different orders, and classes with equal names must have equal scores.
        cosines = np.einsum("ij,j->i", classes, vector)
        candidates = (
            Candidate(cls.iri, min(1.0, float(cosine))) for cls, cosine in zip(tbox.classes, cosines, strict=True)
        )
        ranked = sorted(candidates, key=lambda candidate: (-candidate.score, candidate.class_iri))
        return tuple(ranked[: BASELINES.max_candidates])

    def _predict(
        self, path: str, view: ObjectView, tbox: TBox, ranked: Mapping[str, tuple[Candidate, ...]]
    ) -> Prediction:
        if not view.name.strip():
            return Prediction(path, None, None, Status.REFUSED, self.name, "it has no name to compare")
        text = self._text(view.name)
        candidates = ranked[text]
        best = candidates[0]
        explanation = self._explain(text, candidates, tbox)
        confidence = max(0.0, best.score)
        return Prediction(
            path, best.class_iri, confidence, Status.GROUNDED, self.name, explanation, ("name",), candidates
        )

    def _explain(self, text: str, candidates: Sequence[Candidate], tbox: TBox) -> str:
        nearest = [
            f"“{self._text(tbox.by_iri[c.class_iri].readable_name)}” (cosine {c.score:.2f})" for c in candidates[:2]
        ]
        return f"of all class names, “{text}” is nearest to {', then '.join(nearest)}"
