"""The matrix of the study: its strategies, baselines, naming regimes and ablation, on one scene."""

from usd2kg.errors import GroundingError
from usd2kg.evaluation.matrix import STUDY_ABLATION, Matrix, SceneSpec
from usd2kg.grounding import NamingRegime, make_grounder

__all__ = ["STUDY_OBJECTS", "STUDY_STRATEGIES", "find_unavailable_baselines", "plan_study"]

STUDY_OBJECTS = 125
"""Objects of the Kitchen Set in the study."""
STUDY_STRATEGIES = ("A", "B", "C")
_BASELINES = ("dictionary", "volume", "embedding")
"""The study's Multiverse, LV-NN and S-BERT."""
_OWN = "lexical"
_ABLATED = "B"
"""The strategy of the study's ablation. Strategy A has no evidence to remove except the name."""


def find_unavailable_baselines() -> dict[str, str]:
    """Return baseline → why it cannot run, for those whose extra is not installed."""
    found = {}
    for name in _BASELINES:
        try:
            make_grounder(name)
        except GroundingError as error:
            found[name] = str(error)
    return found


def plan_study(scene: SceneSpec, model: str | None, *, without: frozenset[str] = frozenset()) -> Matrix:
    """Return the study's matrix on a scene.

    The baselines, the lexical grounder and the strategies A, B and C run under all naming regimes; the lexical
    grounder and strategy B also run under the six conditions of the study's ablation.

    Args:
        scene: the scene with its gold labels.
        model: the language model, like `google:gemini-2.5-flash`; None for the offline methods only.
        without: baselines to leave out.
    """
    strategies = {letter: f"llm-{letter}:{model}" for letter in STUDY_STRATEGIES} if model is not None else {}
    return Matrix(
        title=f"The study's matrix on {scene.name}",
        scenes=(scene,),
        grounders=(*(name for name in _BASELINES if name not in without), _OWN, *strategies.values()),
        regimes=tuple(NamingRegime),
        repeats=1,
        ablation=STUDY_ABLATION,
        ablated=(_OWN, *(name for letter, name in strategies.items() if letter == _ABLATED)),
    )
