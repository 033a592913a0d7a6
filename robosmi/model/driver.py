"""The documented path of `robosmi.model.elements.driver`."""

from robosmi.model.elements.driver import (
    DynamicNode as DynamicNode,
)
from robosmi.model.elements.driver import (
    FeatureValue as FeatureValue,
)
from robosmi.model.elements.driver import (
    Item as Item,
)
from robosmi.model.elements.driver import (
    ItemOrItems as ItemOrItems,
)
from robosmi.model.elements.driver import (
    Kind as Kind,
)
from robosmi.model.elements.driver import (
    Model as Model,
)
from robosmi.model.elements.driver import (
    ModelElement as ModelElement,
)
from robosmi.model.elements.driver import (
    Node as Node,
)
from robosmi.model.elements.driver import (
    ReadOnlyError as ReadOnlyError,
)
from robosmi.model.elements.driver import (
    Type as Type,
)
from robosmi.model.elements.driver import (
    TypeHandle as TypeHandle,
)
from robosmi.model.elements.driver import (
    UnknownTypeError as UnknownTypeError,
)
from robosmi.model.elements.driver import (
    class_of as class_of,
)
from robosmi.model.elements.driver import (
    contents_of as contents_of,
)
from robosmi.model.elements.driver import (
    features_of as features_of,
)
from robosmi.model.elements.driver import (
    is_element as is_element,
)
from robosmi.model.elements.driver import (
    label as label,
)
from robosmi.model.elements.driver import (
    name_of as name_of,
)
from robosmi.model.elements.driver import (
    read_only as read_only,
)
from robosmi.model.elements.driver import (
    type_of as type_of,
)
from robosmi.model.elements.driver import (
    unknown_type as unknown_type,
)
from robosmi.model.elements.driver import (
    walk as walk,
)
