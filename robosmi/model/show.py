"""The documented path of `robosmi.model.elements.show`."""

from robosmi.model.elements.show import (
    K as K,
    Plain as Plain,
    V as V,
    classifiers_html as classifiers_html,
    element_html as element_html,
    items_html as items_html,
    known_values as known_values,
    pairs_html as pairs_html,
    plain as plain,
    rows as rows,
    tree as tree,
)
