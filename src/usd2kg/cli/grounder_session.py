"""The grounder that the options define for one scene: one grounder, or a cascade, with the decisions of a person."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from usd2kg.cli.carried_decisions import carry_over_decisions
from usd2kg.cli.options.grounding import GroundingOptions
from usd2kg.cli.options.review import CarryOverOptions
from usd2kg.cli.output import Progress, count_noun, emit, notify
from usd2kg.errors import GroundingError, SceneError

if TYPE_CHECKING:
    from usd2kg.grounding import CascadeGrounder, Decision, DecisionOrigin, Grounder, Grounding, ObjectView
    from usd2kg.grounding.llm.grounder import LLMGrounder
    from usd2kg.grounding.llm.prompts import ObjectPictures
    from usd2kg.ontology import ClassIRI, TBox
    from usd2kg.scene import ReadOptions, Scene

__all__ = ["GrounderSession", "open_grounder_session", "show_progress"]


@dataclass(frozen=True)
class GrounderSession:
    """An open grounder with its parts."""

    options: GroundingOptions
    grounder: "Grounder"
    offline: "Grounder"
    """The grounder without a language model; the first tier of a cascade."""
    model: "LLMGrounder | None"
    cascade: "CascadeGrounder | None"
    decisions: "Mapping[str, ClassIRI | Decision]"
    carried: "Mapping[str, DecisionOrigin]"
    """Prim path → origin of a decision that was made for another path."""

    def views_for_model(self, views: "list[tuple[str, ObjectView]]", tbox: "TBox") -> "list[tuple[str, ObjectView]]":
        """Return the views that the model has to ground: neither decided nor, in a cascade, grounded offline."""
        undecided = [(path, view) for path, view in views if path not in self.decisions]
        if self.cascade is None:
            return undecided
        return [undecided[index] for index in self.cascade.find_uncertain(self.offline.ground_views(undecided, tbox))]

    def report(self, grounding: "Grounding", tbox: "TBox") -> None:
        """Print the decisions and cost of each tier to stderr, and write the review queue and the alignment.

        Raises:
            GroundingError: see `check_completions`; raised after everything is printed and written.
        """
        from usd2kg.cli.model_report import report_cost, report_tiers  # noqa: PLC0415
        from usd2kg.grounding import find_uncertain, format_queue  # noqa: PLC0415

        if self.cascade is not None or self.decisions:
            report_tiers(grounding, self.cascade, self.model)
        if self.model is not None:
            report_cost(self.model.report, grounding)
        if (queue := self.options.review.queue) is not None:
            waiting = find_uncertain(grounding, self.options.review.person)
            emit(format_queue(waiting, tbox), queue)
            waiting_objects = count_noun(len(waiting), "object")
            notify(f"{waiting_objects} to review in {queue}; fill in the column decision for --decisions")
        self._write_alignment(tbox)
        self.check_completions()

    def _write_alignment(self, tbox: "TBox") -> None:
        """Write the model's answers about concepts, and their number to stderr."""
        target = self.options.model.write_alignment
        if target is None or self.model is None:
            return
        text, count, left_out = self.model.format_alignment(tbox)
        emit(text, target)
        notify(f"{count} rows for --alignment in {target}; {left_out} omitted because of conflicting answers")

    def check_completions(self) -> None:
        """Check that the model completed at least one prompt of the run, if there were any.

        Raises:
            GroundingError: no prompt has a completion, for example because the key is rejected or the budget is spent.
        """
        if self.model is None:
            return
        report = self.model.report
        if report.problem and not (report.completions or report.cached or report.is_interrupted):
            raise GroundingError(
                f"{self.options.grounder}: the model completed none of {report.prompts} prompts "
                f"({report.problem}); the output contains no classes from the model"
            )


def show_progress(options: GroundingOptions, *steps: str, is_wanted: bool = True) -> AbstractContextManager[None]:
    """Return a context that shows a progress bar of steps, except for a language model, which has its own line."""
    from usd2kg.grounding import is_llm_name  # noqa: PLC0415 - slow to import
    from usd2kg.progress import show_steps  # noqa: PLC0415

    return nullcontext() if is_llm_name(options.grounder) else show_steps(*steps, is_wanted=is_wanted)


@contextmanager
def open_grounder_session(
    options: GroundingOptions,
    scene: "Scene",
    tbox: "TBox",
    source: Path,
    reading: "ReadOptions",
    carry_over: CarryOverOptions | None = None,
) -> Iterator[GrounderSession]:
    """Open the grounder for one scene.

    Args:
        options: the grounder, its model, and the decisions.
        scene: the scene to ground.
        tbox: the classes of the decisions.
        source: the stage of the scene, to render thumbnails.
        reading: how the stage was read.
        carry_over: options for decisions that were made for an earlier version.

    Raises:
        Usd2kgError: options exclude each other, or a file or model cannot be opened.
    """
    from usd2kg import grounding  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    decisions: Mapping[str, ClassIRI | Decision] = options.review.read(tbox)
    carried: Mapping[str, DecisionOrigin] = {}
    if carry_over is not None:
        decisions, carried = carry_over_decisions(decisions, scene, reading, carry_over)
    is_llm = grounding.is_llm_name(options.grounder)
    if not is_llm:
        options.model.check_without_model()
    elif options.alignment is not None and options.model.cascade is None:
        raise GroundingError("--alignment is for the lexical grounder; expected --grounder lexical, or --cascade too")
    if (target := options.model.write_alignment) is not None:
        _check_alignment_target(options.grounder, target)
    offline = grounding.make_grounder(
        "lexical" if is_llm else options.grounder,
        dictionary=options.dictionary,
        class_sizes=options.class_sizes,
        abstains=options.abstain,
        alignment=options.alignment,
    )
    with ExitStack() as stack:
        model = cascade = None
        if is_llm:
            model = stack.enter_context(_open_model(options, scene, decisions, source, reading))
            if options.model.cascade is not None:
                cascade = grounding.CascadeGrounder(offline, model, options.model.cascade)
        yield GrounderSession(options, cascade or model or offline, offline, model, cascade, decisions, carried)


def _check_alignment_target(grounder: str, target: Path) -> None:
    from usd2kg.files import check_writable  # noqa: PLC0415
    from usd2kg.grounding.llm.factory import parse_llm_name  # noqa: PLC0415
    from usd2kg.grounding.llm.prompt_options import Strategy  # noqa: PLC0415

    if parse_llm_name(grounder)[1] is not Strategy.BY_CONCEPT:
        raise GroundingError("--write-alignment needs answers about concepts; expected --grounder llm-concept:MODEL")
    check_writable(target)


@contextmanager
def _open_model(
    options: GroundingOptions,
    scene: "Scene",
    decisions: "Mapping[str, ClassIRI | Decision]",
    source: Path,
    reading: "ReadOptions",
) -> "Iterator[LLMGrounder]":
    from usd2kg.grounding.llm.batch_jobs.queue import Reporting  # noqa: PLC0415
    from usd2kg.grounding.llm.factory import open_llm_grounder  # noqa: PLC0415
    from usd2kg.grounding.llm.few_shot_choice import choose_examples  # noqa: PLC0415

    asked = options.model
    if asked.examples and not decisions:
        raise GroundingError("--examples shows a person's decisions; give their file with --decisions FILE")
    with (
        Progress() as progress,
        open_llm_grounder(
            asked.settings(options.grounder),
            is_dry=asked.requests.dry_run,
            examples=choose_examples(scene, decisions, asked.examples) if asked.examples else (),
            pictures=_renderer(source, reading) if asked.thumbnails else None,
            progress=progress.update,
            reporting=Reporting(progress.say, progress.show),
        ) as model,
    ):
        progress.follow(model.report)
        yield model


def _renderer(source: Path, reading: "ReadOptions") -> "Callable[[str], ObjectPictures | None]":
    """Return a function from prim path to pictures, or to None for an instance or an object without geometry."""
    from usd2kg.grounding.llm.prompts import ObjectPictures  # noqa: PLC0415
    from usd2kg.render import Renderer  # noqa: PLC0415

    renderer = Renderer(source, reading)

    def render(path: str) -> ObjectPictures | None:
        try:
            return ObjectPictures(renderer.render_object(path), renderer.render_object(path, in_context=True))
        except SceneError:
            return None

    return render
