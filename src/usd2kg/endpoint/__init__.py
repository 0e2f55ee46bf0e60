"""A read-only SPARQL 1.1 endpoint over a graph or a store, with a query page."""

from usd2kg.endpoint.bounded import BoundedQueries
from usd2kg.endpoint.endpoint_limits import EndpointLimits
from usd2kg.endpoint.listening import Address
from usd2kg.endpoint.serving import ServeOptions, serve

__all__ = [
    "Address",
    "BoundedQueries",
    "EndpointLimits",
    "ServeOptions",
    "serve",
]
