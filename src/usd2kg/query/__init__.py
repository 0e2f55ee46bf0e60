"""Queries over a graph: SPARQL, geometric functions, and ready questions in English."""

from usd2kg.query.answer import Answer
from usd2kg.query.dataset import FUNCTION_NAMESPACE, Dataset, term_list
from usd2kg.query.functions import FUNCTIONS
from usd2kg.query.graph_file import load_graph
from usd2kg.query.graph_store import GraphStore
from usd2kg.query.named_objects import find_prim_paths
from usd2kg.query.questions import Parameter, Question, list_questions

__all__ = [
    "FUNCTIONS",
    "FUNCTION_NAMESPACE",
    "Answer",
    "Dataset",
    "GraphStore",
    "Parameter",
    "Question",
    "find_prim_paths",
    "list_questions",
    "load_graph",
    "term_list",
]
