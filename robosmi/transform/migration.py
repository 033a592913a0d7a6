"""`ModelMigration`: a step from an older version of a metamodel to the next, as content registers it (kind "model migration").

The rules are a Flock migration; this object only brings the models together. `robosmi.model.versions` finds and calls it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.errors import RuleError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.ecore.metamodels import Metamodels, built_in
from robosmi.model.elements.ecore import EObject, Package
from robosmi.model.elements.features import eclass_of
from robosmi.model.emf import EmfModel
from robosmi.transform.flock import Flock
from robosmi.transform.flock_rules import left_out_fix, left_out_text


class ModelMigration(Struct, dict=True):
    """A step between two versions.

    Attributes:
        old: the .ecore file of the older version. What it refers to in other files (`ccode.ecore#//Call`) comes from the newer
            packages where they have that namespace, so that elements of other models stay what they are.
        rules: adds the rules to a `Flock`; values that the newer version still accepts are copied without rules.
        new: packages of the newer version; if None those that a model is loaded with, and the built-in ones.
        assumed: the namespaces of the metamodel that a model is loaded with, if these are the newer version since none is named.
    """

    old: Path
    rules: Callable[[Flock], object]
    new: Metamodel | None = None
    assumed: str | None = None

    @cached_property
    def _metamodel(self) -> Metamodel:
        older = [p for p in Metamodel.load(self.old).epackages if self._new.get(p.nsURI) is None]
        for feature in (f for p in older for c in p.eClassifiers for f in getattr(c, "eStructuralFeatures", ())):
            kind = eclass_of(feature.eType)
            current = self._new.get(kind.ePackage.nsURI) if kind.ePackage not in older else None
            if current is not None:
                feature.eType = current.getEClassifier(kind.name)
        return Metamodel(older)

    @cached_property
    def _new(self) -> Metamodel:
        return self.new or Metamodel(built_in().packages)

    def into(self, metamodels: Metamodels) -> ModelMigration:
        """The same step, into these metamodels where it names no newer version itself.

        Args:
            metamodels: those that a model is loaded with.
        """
        if self.new is not None:
            return self
        known = {package.nsURI for package in metamodels.packages}
        others = [package for package in built_in().packages if package.nsURI not in known]
        namespaces = ", ".join(str(package.nsURI) for package in metamodels.packages)
        return ModelMigration(self.old, self.rules, Metamodel([*metamodels.packages, *others]), namespaces)

    def packages(self) -> list[Package]:
        """The packages of the older version."""
        return list(self._metamodel.packages)

    def __call__(self, roots: Mapping[Path, EObject]) -> dict[Path, EObject]:
        """The roots of models in the newer version, migrated together; the model for the rules is at the first one's path.

        Args:
            roots: file -> root of a model in the older version.

        Raises:
            RuleError: a rule raises, elements without a rule would be lost, or there are not as many roots as
                before.
        """
        given = {
            root.eClass.ePackage.nsURI: root.eClass.ePackage for root in roots.values()
        }  # an earlier step's, loaded on their own
        old = Metamodel([*(given.get(p.nsURI, p) for p in self._metamodel.epackages), *self._new.packages])
        original = EmfModel(list(roots.values()), old, "Old", next(iter(roots), None))
        f = Flock(original, EmfModel((), self._new, "New"), keep_order=True)
        self.rules(f)
        left = f.run().roots
        made: dict[Path, EObject] = {file: new for file, root in roots.items() if isinstance(new := f.equivalent(root), EObject)}
        if len(left) != len(roots) or len(made) != len(roots):
            (first, *_), several = roots.values(), len(roots) > 1
            expected = quantity(len(roots), "root") if several else "one"
            raise RuleError(
                f"migrating {first!r} of {first.eClass.ePackage.nsURI} leaves {quantity(len(left), 'root')} "
                f"instead of {expected}",
                fix="retype the classes that were renamed: retype(old, new)",
            )
        if f.left_out:
            source = next(iter(roots.values())).eClass.ePackage.nsURI
            raise RuleError(f"migrating a model of {source}: {left_out_text(f.left_out)}", fix=left_out_fix(f.left_out))
        return made
