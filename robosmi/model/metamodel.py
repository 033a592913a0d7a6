"""The documented path of `robosmi.model.ecore.metamodel`."""

from robosmi.model.ecore.metamodel import (
    Metamodel as Metamodel,
    Packages as Packages,
    TypedModel as TypedModel,
    find_literal as find_literal,
    make_strict as make_strict,
)
