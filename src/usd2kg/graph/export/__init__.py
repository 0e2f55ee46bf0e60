"""Graphs for other systems: property graphs (Neo4j, GraphML) and SSSOM mappings."""
