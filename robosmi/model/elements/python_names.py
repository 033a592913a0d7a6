"""The names of a metamodel as Python names: the escape rule, in one place.

A name stays as it is where Python allows. Else: each character that no identifier has becomes `_`; a leading digit gets `_`
before it, several leading underscores become one; a keyword, a name that pyecore or the generated module needs for itself, and
a name that is taken get `_` behind. The name of the metamodel itself is kept beside it and is what model files say.
"""

from __future__ import annotations

import keyword
import re
import unicodedata
from collections.abc import Collection

from robosmi.model.elements.pyecore_internals import FIELDS

_FOREIGN = re.compile(r"[^A-Za-z0-9_]")

MODULE = frozenset(
    {
        "name", "nsURI", "nsPrefix", "eClass", "eClassifiers", "getEClassifier", "eSubpackages", "eSuperPackage", "eURIFragment",
        "dyn_inst", "mixins", "annotations", "_defined", "_link",
    }
)  # fmt: skip
"""Names that a generated module needs for itself."""

MEMBER = frozenset(
    {
        "allInstances", "cls", "delete", "dyn_inst", "eAllContents", "eClass", "eContainer", "eContainmentFeature", "eContents",
        "eGet", "eIsSet", "eResource", "eRoot", "eSet", "eURIFragment", "force_resolve", "listeners", "mro", "notify", "self",
        *FIELDS,
    }
)  # fmt: skip
"""Names that every element has, and those that a constructor cannot take as keywords."""

LITERAL = frozenset(
    {
        "allInstances", "default_value", "delete", "dyn_inst", "eAllContents", "eAnnotations", "eClass",
        "eContainer", "eContainmentFeature", "eContents", "eGet", "eIsSet", "eLiterals", "ePackage", "eResource", "eRoot", "eSet",
        "eType", "eTypeParameters", "eURIFragment", "force_resolve", "from_string", "getEAnnotation", "getEEnumLiteral",
        "instanceClassName", "instanceClassName_", "listeners", "literal", "mro", "name",
        "notify", "notifyChanged", "to_string", "transmap", "type_as_factory", "value",
    }
)  # fmt: skip
"""Names that an enumeration or a literal has."""


def python_name(name: str, reserved: Collection[str] = (), taken: Collection[str] = ()) -> str:
    """The Python name for a name of a metamodel.

    Args:
        name: the name in the metamodel, not empty.
        reserved: names with a meaning of their own in that place.
        taken: names that others in that place have already.
    """
    text = _FOREIGN.sub(_known, unicodedata.normalize("NFKC", name))
    text = re.sub("^__+", "_", text)
    if not text.isidentifier():
        text = f"_{text}"
    if keyword.iskeyword(text) or text in reserved or text == "_" or (text[:1] == "_" and hasattr(object, text)):
        text += "_"
    while text in taken:
        text += "_"
    return text


def _known(letter: re.Match[str]) -> str:
    """A letter that an identifier may have, or `_`: those of `\\w` are not all among them."""
    return letter[0] if f"_{letter[0]}".isidentifier() else "_"
