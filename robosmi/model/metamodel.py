"""The documented path of `robosmi.model.ecore.metamodel`."""

from robosmi.model.ecore.metamodel import (
    Metamodel as Metamodel,
)
from robosmi.model.ecore.metamodel import (
    Packages as Packages,
)
from robosmi.model.ecore.metamodel import (
    TypedModel as TypedModel,
)
from robosmi.model.ecore.metamodel import (
    find_literal as find_literal,
)
from robosmi.model.ecore.metamodel import (
    make_strict as make_strict,
)
