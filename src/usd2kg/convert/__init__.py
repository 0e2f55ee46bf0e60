"""Files of other formats → stages in memory, by converters that are installed as extras."""

from usd2kg.convert.formats import (
    FORMATS,
    LAYER_ENDINGS,
    SCENE_ENDINGS,
    STAGE_ENDINGS,
    SourceFormat,
    find_format,
    is_scene_folder,
    is_stage,
    refuse_other_xml,
    stages_in,
)
from usd2kg.convert.origin import SOURCE_ID, Origin, read_origin

__all__ = [
    "FORMATS",
    "LAYER_ENDINGS",
    "SCENE_ENDINGS",
    "SOURCE_ID",
    "STAGE_ENDINGS",
    "Origin",
    "SourceFormat",
    "find_format",
    "is_scene_folder",
    "is_stage",
    "read_origin",
    "refuse_other_xml",
    "stages_in",
]
