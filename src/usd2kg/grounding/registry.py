"""Grounders by name."""

from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.base import Grounder

__all__ = ["GROUNDERS", "is_llm_name", "make_grounder"]

GROUNDERS = ("lexical", "dictionary", "embedding", "volume")
"""The names for `make_grounder`, the default first, without those of language models."""


def is_llm_name(name: str) -> bool:
    """Return whether a grounder name is that of a language model."""
    return name.startswith(("llm-", "llm:"))


def make_grounder(
    name: str,
    *,
    dictionary: Path | None = None,
    class_sizes: Path | None = None,
    abstains: bool = False,
    alignment: Path | None = None,
) -> Grounder:
    """Return the grounder called `name`.

    Args:
        name: one of `GROUNDERS`, or a strategy and a language model: `llm-B:google:gemini-2.5-flash`, with the default
            settings; `usd2kg.grounding.llm.factory.open_llm_grounder` takes others.
        dictionary: for `dictionary`, a CSV file with the columns `name,class`.
        class_sizes: for `volume`, a CSV file of typical sizes.
        abstains: for `lexical`, choose a superclass where the candidates disagree.
        alignment: for `lexical`, an edited file of `usd2kg ontology align`.

    Raises:
        GroundingError: the name is unknown, an option does not apply to it, or a file cannot be read.
    """
    if dictionary is not None and name != "dictionary":
        raise GroundingError(
            f"grounder {name!r} takes no dictionary; choose the grounder dictionary to use {dictionary}"
        )
    if class_sizes is not None and name != "volume":
        raise GroundingError(f"grounder {name!r} takes no class sizes; choose the grounder volume to use {class_sizes}")
    if abstains and name != "lexical":
        raise GroundingError(f"grounder {name!r} cannot abstain; choose the grounder lexical")
    if alignment is not None and name != "lexical":
        raise GroundingError(f"grounder {name!r} takes no alignment; choose the grounder lexical to use {alignment}")
    # Imported on demand: the lexical grounder reads a noun taxonomy, others need optional dependencies.
    if name == "lexical":
        from usd2kg.grounding.lexical.grounder import LexicalGrounder  # noqa: PLC0415

        if alignment is None:
            return LexicalGrounder(abstains=abstains)
        from usd2kg.grounding.lexical.alignment.alignment_file import read_alignment_file  # noqa: PLC0415

        return LexicalGrounder(abstains=abstains, alignment=read_alignment_file(alignment))
    if name == "dictionary":
        from usd2kg.grounding.baselines.dictionary import DictionaryGrounder  # noqa: PLC0415

        return DictionaryGrounder.from_csv(dictionary) if dictionary else DictionaryGrounder.multiverse()
    if name == "embedding":
        from usd2kg.grounding.baselines.embedding.grounder import EmbeddingGrounder  # noqa: PLC0415

        return EmbeddingGrounder()
    if name == "volume":
        from usd2kg.grounding.baselines.volume import VolumeGrounder  # noqa: PLC0415

        return VolumeGrounder.from_csv(class_sizes) if class_sizes else VolumeGrounder()
    if is_llm_name(name):
        from usd2kg.grounding.llm.factory import make_llm_grounder  # noqa: PLC0415

        return make_llm_grounder(name)
    raise GroundingError(f"grounder {name!r} is unknown; expected one of {', '.join(GROUNDERS)}, or llm-B:MODEL")
