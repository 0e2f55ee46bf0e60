"""The test flat: a scene kept aside to measure grounding, with labels given by its author."""
