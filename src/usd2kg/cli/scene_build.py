"""SceneBuild: the options that build the graph of a scene, as a value that can be sent to another process."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usd2kg.cli.grounder_session import GrounderSession, open_grounder_session
from usd2kg.cli.options.graph import AnnotationOptions, SpatialOptions
from usd2kg.cli.options.grounding import GroundingOptions
from usd2kg.cli.options.review import CarryOverOptions
from usd2kg.cli.options.stage import StageOptions

if TYPE_CHECKING:
    from usd2kg.ontology import TBox
    from usd2kg.pipeline import BuildResult

__all__ = ["SceneBuild"]


@dataclass(frozen=True)
class SceneBuild:
    """How a scene is read, grounded and related."""

    grounding: GroundingOptions
    reading: StageOptions
    spatial: SpatialOptions
    annotation: AnnotationOptions
    profile: str
    carry_over: CarryOverOptions | None = None

    def check(self) -> None:
        """Check the options before a scene is read.

        Raises:
            Usd2kgError: an option is invalid.
        """
        self.grounding.evidence_groups, self.grounding.naming_regime  # noqa: B018 - properties that check
        self.reading.read_options()
        self.spatial.relation_options()
        self.annotation.graph_options()

    @contextmanager
    def run(
        self, source: Path, tbox: "TBox | None", base: str | None
    ) -> "Iterator[tuple[BuildResult, GrounderSession]]":
        """Build the graph of a scene; the grounder is open until the context ends.

        Without a TBox, the built-in one that suits the scene is used.

        Raises:
            Usd2kgError: an input cannot be read, or an option is invalid.
        """
        from usd2kg.grounding.built_in_choice import stated_places  # noqa: PLC0415
        from usd2kg.pipeline import build, open_tbox  # noqa: PLC0415 - loads OpenUSD, too slow for --help
        from usd2kg.scene import read_scene  # noqa: PLC0415

        options = self.reading.read_options()
        scene = read_scene(source, options=options)
        tbox = tbox or open_tbox(None, scene, stated=stated_places(self.grounding.review.decisions))
        with open_grounder_session(self.grounding, scene, tbox, source, options, self.carry_over) as session:
            result = build(
                scene,
                tbox,
                grounder=session.grounder,
                regime=self.grounding.naming_regime,
                evidence=self.grounding.evidence_groups,
                decisions=session.decisions,
                carried=session.carried,
                base=base,
                profile=self.profile,
                graph_options=self.annotation.graph_options(),
                relations=self.spatial.relation_options(),
            )
            yield result, session
