"""The documented path of `robosmi.model.elements.show`."""

from robosmi.model.elements.show import (
    K as K,
)
from robosmi.model.elements.show import (
    Plain as Plain,
)
from robosmi.model.elements.show import (
    V as V,
)
from robosmi.model.elements.show import (
    classifiers_html as classifiers_html,
)
from robosmi.model.elements.show import (
    element_html as element_html,
)
from robosmi.model.elements.show import (
    items_html as items_html,
)
from robosmi.model.elements.show import (
    known_values as known_values,
)
from robosmi.model.elements.show import (
    pairs_html as pairs_html,
)
from robosmi.model.elements.show import (
    plain as plain,
)
from robosmi.model.elements.show import (
    rows as rows,
)
from robosmi.model.elements.show import (
    tree as tree,
)
