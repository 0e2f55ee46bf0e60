"""Grounding with large language models: prompts, clients, the completion cache, and the grounder."""
