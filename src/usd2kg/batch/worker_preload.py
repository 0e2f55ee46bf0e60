"""Preloaded by the fork server: workers share the memory of the data loaded here."""

from usd2kg.grounding import ObjectView, make_grounder
from usd2kg.ontology import load_home_tbox, load_places_tbox
from usd2kg.pipeline import build

__all__ = ["build"]

# Grounding one name loads the lexicon and all tables; an ontology of the user adds its own in each worker.
for tbox in (load_home_tbox(), load_places_tbox()):
    make_grounder("lexical").ground_views([("/cup", ObjectView(name="cup"))], tbox)
