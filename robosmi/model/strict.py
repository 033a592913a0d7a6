"""The documented path of `robosmi.model.elements.strict`."""

from robosmi.model.elements.strict import (
    Element as Element,
    EnumLiteral as EnumLiteral,
    FeatureValueError as FeatureValueError,
    UnknownFeatureError as UnknownFeatureError,
    enum_literal as enum_literal,
)
