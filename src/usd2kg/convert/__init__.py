"""Files of other formats → stages in memory, by converters that are installed as extras."""

from usd2kg.convert.formats import FORMATS, LAYER_ENDINGS, STAGE_ENDINGS, SourceFormat, find_format, is_stage
from usd2kg.convert.origin import SOURCE_ID, Origin, read_origin

__all__ = [
    "FORMATS",
    "LAYER_ENDINGS",
    "SOURCE_ID",
    "STAGE_ENDINGS",
    "Origin",
    "SourceFormat",
    "find_format",
    "is_stage",
    "read_origin",
]
