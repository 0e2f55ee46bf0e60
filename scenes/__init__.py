"""Scenes authored by script, for the demo and the benchmarks."""
