"""Grounding by large language models: prompts, clients, the cache of completions, the grounder."""
