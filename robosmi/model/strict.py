"""The documented path of `robosmi.model.elements.strict`."""

from robosmi.model.elements.strict import (
    Element as Element,
)
from robosmi.model.elements.strict import (
    EnumLiteral as EnumLiteral,
)
from robosmi.model.elements.strict import (
    FeatureValueError as FeatureValueError,
)
from robosmi.model.elements.strict import (
    UnknownFeatureError as UnknownFeatureError,
)
from robosmi.model.elements.strict import (
    enum_literal as enum_literal,
)
