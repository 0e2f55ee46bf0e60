"""usd2kg eval: evaluation of grounding against gold labels."""

import typer

from usd2kg.cli.evaluate import fetch, gold, matrix, run, stored, study

__all__ = ["app"]

app = typer.Typer(no_args_is_help=True, rich_markup_mode=None, help="Evaluate grounding against gold labels.")
app.command("run")(run.run_command)
app.command("calibrate")(stored.calibrate_command)
app.command("reproduce")(matrix.reproduce_command)
app.command("compare")(stored.compare_command)
app.command("annotate")(gold.annotate_command)
app.command("fetch")(fetch.fetch_command)
app.command("agreement")(gold.agreement_command)
app.command("kitchen-set")(study.kitchen_set_command)
