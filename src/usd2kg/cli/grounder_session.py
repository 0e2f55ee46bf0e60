"""A grounder for a scene as the options say it: one, or several in a row, with what people decided."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usd2kg.cli.carry_options import CarryOptions
from usd2kg.cli.model_options import ModelOptions
from usd2kg.cli.options import Abstains, ClassSizes, Dictionary, Evidence, GrounderName, Regime
from usd2kg.cli.output import Progress, emit, talk
from usd2kg.errors import GroundingError, SceneError

if TYPE_CHECKING:
    from usd2kg.grounding import Carried, CascadeGrounder, Grounder, Grounding, NamingRegime, ObjectView
    from usd2kg.grounding.llm.grounder import LLMGrounder
    from usd2kg.grounding.llm.prompts import Example
    from usd2kg.ontology import ClassIRI, TBox
    from usd2kg.scene import ReadOptions, Scene

__all__ = ["GroundingOptions", "GroundingRun", "check_files_apart", "open_run"]

_PICTURE = (256, 256)


@dataclass(frozen=True)
class GroundingOptions:
    """Who chooses the classes, and what is seen of the objects."""

    grounder: GrounderName = "lexical"
    dictionary: Dictionary = None
    abstain: Abstains = False
    class_sizes: ClassSizes = None
    regime: Regime = "semantic"
    evidence: Evidence = None

    @property
    def naming_regime(self) -> "NamingRegime":
        """How names are masked."""
        from usd2kg.grounding import parse_regime  # noqa: PLC0415 - opens OpenUSD, too slow for --help

        return parse_regime(self.regime)

    @property
    def groups(self) -> frozenset[str] | None:
        """The evidence that may be used; None for all."""
        from usd2kg.grounding import parse_evidence  # noqa: PLC0415

        return parse_evidence(self.evidence) if self.evidence is not None else None


@dataclass(frozen=True)
class GroundingRun:
    """A grounder that is ready, and what it consists of."""

    grounder: "Grounder"
    model: "LLMGrounder | None"
    tiers: "CascadeGrounder | None"
    quick: "Grounder"
    """The one that asks nobody."""
    decisions: "Mapping[str, ClassIRI]"
    carried: "Mapping[str, Carried]"
    """Where decisions come from that were made about another path."""

    def unsure(self, views: "list[tuple[str, ObjectView]]", tbox: "TBox") -> "list[tuple[str, ObjectView]]":
        """Return the views that the model would be asked about."""
        open_views = [(path, view) for path, view in views if path not in self.decisions]
        if self.tiers is None:
            return open_views
        return [open_views[index] for index in self.tiers.unsure(self.quick.ground_views(open_views, tbox))]

    def tell(self, result: "Grounding", options: ModelOptions, tbox: "TBox") -> None:
        """Print on stderr what each tier decided and what the model cost, and write the queue for a person."""
        from usd2kg.cli.model_run import tell_cost, tell_tiers  # noqa: PLC0415
        from usd2kg.grounding import format_queue, unsure_of  # noqa: PLC0415

        if self.tiers is not None or self.decisions:
            tell_tiers(result, self.tiers, self.model)
        if self.model is not None:
            tell_cost(self.model.report, result)
        if options.queue is not None:
            waiting = unsure_of(result, options.person)
            emit(format_queue(waiting, tbox), options.queue)
            talk(f"{len(waiting)} objects wait for a person: fill in the decisions of {options.queue}")


def check_files_apart(
    outputs: Iterable[Path | None],
    inputs: Iterable[Path | None],
    chosen: GroundingOptions,
    asked: ModelOptions,
    carrying: CarryOptions | None = None,
) -> None:
    """Raise OutputError where a file that would be written, by these options too, is one that is read."""
    from usd2kg.files import check_apart  # noqa: PLC0415

    carried = (carrying.unplaced, carrying.carried) if carrying is not None else ()
    previous = carrying.previous if carrying is not None else None
    read = (chosen.dictionary, chosen.class_sizes, asked.decisions, asked.calibration, asked.completions, previous)
    check_apart((*outputs, asked.queue, *carried), (*inputs, *read))


@contextmanager
def open_run(
    chosen: GroundingOptions,
    asked: ModelOptions,
    scene: "Scene",
    tbox: "TBox",
    source: Path,
    reading: "ReadOptions",
    carrying: CarryOptions | None = None,
) -> Iterator[GroundingRun]:
    """Open the grounder for one scene.

    Raises:
        Usd2kgError: options do not go together, or a file or model cannot be opened.
    """
    from usd2kg import grounding  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    decisions = grounding.read_decisions(asked.decisions, tbox) if asked.decisions is not None else {}
    placed, carried = carrying.carry(decisions, scene, reading) if carrying is not None else (decisions, {})
    is_model = grounding.is_llm_name(chosen.grounder)
    if not is_model:
        asked.refuse_without_model()
    quick = grounding.make_grounder(
        "lexical" if is_model else chosen.grounder,
        dictionary=chosen.dictionary,
        class_sizes=chosen.class_sizes,
        abstains=chosen.abstain,
    )
    with ExitStack() as stack:
        model = None
        if is_model:
            from usd2kg.grounding.llm.settings import open_llm_grounder  # noqa: PLC0415 - the extra is heavy

            progress = stack.enter_context(Progress())
            model = stack.enter_context(
                open_llm_grounder(
                    asked.settings(chosen.grounder),
                    is_dry=asked.dry_run,
                    examples=_examples(scene, placed, asked.examples),
                    picture=_pictures(source, reading) if asked.thumbnails else None,
                    progress=progress.objects,
                )
            )
            progress.follow(model.report)
        tiers = None
        if model is not None and asked.cascade is not None:
            tiers = grounding.CascadeGrounder(quick, model, asked.cascade)
        yield GroundingRun(tiers or model or quick, model, tiers, quick, placed, carried)


def _examples(scene: "Scene", decisions: "Mapping[str, ClassIRI]", most: int) -> "list[Example]":
    """Return the first decisions of each class, then the second ones, up to so many."""
    from usd2kg.grounding import view_objects  # noqa: PLC0415
    from usd2kg.grounding.llm.prompts import Example  # noqa: PLC0415

    if most and not decisions:
        raise GroundingError("--examples shows decisions of a person; say where they are with --decisions FILE")
    views = {obj.prim_path: view for obj, view in view_objects(scene) if obj.prim_path in decisions}
    ranks: dict[str, int] = {}
    ranked = []
    for path, view in views.items():
        iri = decisions[path]
        ranks[iri] = ranks.get(iri, 0) + 1
        ranked.append((ranks[iri], path, Example(view, iri)))
    return [example for _, _, example in sorted(ranked, key=lambda row: row[:2])[:most]]


def _pictures(source: Path, reading: "ReadOptions") -> Callable[[str], bytes | None]:
    from usd2kg.render import Renderer  # noqa: PLC0415

    renderer = Renderer(source, reading)

    def picture(path: str) -> bytes | None:
        try:
            return renderer.render_object(path, size=_PICTURE)
        except SceneError:
            # A copy of a point instancer, or an object whose geometry is missing: it is asked about without a picture.
            return None

    return picture
