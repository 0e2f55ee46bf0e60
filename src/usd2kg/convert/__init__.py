"""Files of other formats → stages in memory, by converters that are installed as extras."""

from usd2kg.convert.formats import FORMATS, SourceFormat, find_format
from usd2kg.convert.origin import Origin, read_origin

__all__ = ["FORMATS", "Origin", "SourceFormat", "find_format", "read_origin"]
