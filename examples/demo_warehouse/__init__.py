"""The demo warehouse, authored by script; see README.md."""
