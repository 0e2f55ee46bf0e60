"""Batch jobs: prompts that a service completes within 24 hours at half the price."""
