"""Files of other formats → stages in memory, by converters that are installed as extras."""

from usd2kg.convert.formats import FORMATS, SourceFormat, find_format
from usd2kg.convert.origin import SOURCE_ID, Origin, read_origin

__all__ = ["FORMATS", "SOURCE_ID", "Origin", "SourceFormat", "find_format", "read_origin"]
