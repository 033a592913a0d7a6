"""What stands for pyecore's resource: the file of root elements, through which pyecore's notifications reach their models.

pyecore asks `Home` for listeners and roots; `Watch` is a listener, also in pyecore's own resources. Neither knows the model. As
in EMF, a root may be contained in an element of another file and stays a root of its own.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any

from robosmi.model.elements.ecore import EObject
from robosmi.model.elements.pyecore_internals import ListenedTo, container_of, own_resource_of, set_own_resource


class Watch:
    """A listener that records changes: `touched` for any change, `changed` for a change of containment."""

    __slots__ = ("changed", "touched")

    def __init__(self) -> None:
        self.changed = self.touched = True

    def notifyChanged(self, notification: Any) -> None:
        """Called by pyecore."""
        self.touched = True
        if not self.changed:
            feature = notification.feature
            self.changed = feature is None or (feature.is_reference and feature.containment)


class FileWatch:
    """A listener that records in what files elements changed. Of a part in a file of its own, the outermost home hears."""

    def __init__(self) -> None:
        self.files: set[Path] = set()

    def notifyChanged(self, notification: Any) -> None:
        """Called by pyecore."""
        element = notification.notifier
        while (home := home_of(element)) is None and (container := container_of(element)) is not None:
            element = container
        if home is not None and home.place is not None:
            self.files.add(home.place)


class Home(ListenedTo):
    """The attributes that pyecore needs of a resource: listeners and roots.

    Args:
        watch: receives changes; None for a file that is no model yet.
        place: the file, None as long as there is none.
    """

    def __init__(self, watch: Watch | None, place: Path | None) -> None:
        super().__init__([] if watch is None else [watch])
        self.place = place
        self.is_model = watch is not None
        self.contents = _Roots()
        self.shared_ids: Collection[str] = ()
        """Ids that several elements of the file had when it was read."""

    def add(self, root: EObject) -> None:
        """Make an element a root of this file."""
        set_own_resource(root, self)
        self.contents.append(root)

    def remove(self, root: EObject) -> None:
        """Called by pyecore when a root is put into a container."""
        self.contents.remove(root)
        set_own_resource(root, None)
        for listener in self.listeners:
            if isinstance(listener, Watch):
                listener.changed = True


class _Roots:
    """The roots of a home, in order, with constant-time membership test."""

    def __init__(self) -> None:
        self._items: dict[int, Any] = {}

    def __contains__(self, root: EObject) -> bool:
        return id(root) in self._items

    def __len__(self) -> int:
        return len(self._items)

    def __iter__(self) -> Iterator[Any]:
        return iter(list(self._items.values()))

    def index(self, root: EObject) -> int:
        """The position of a root."""
        return list(self._items).index(id(root))

    def append(self, root: EObject) -> None:
        """Add a root."""
        self._items[id(root)] = root

    def remove(self, root: EObject) -> None:
        """Take a root out, if it is one."""
        self._items.pop(id(root), None)


def home_of(root: EObject) -> Home | None:
    """The file that an element is a root of, or None."""
    found = own_resource_of(root)
    return found if isinstance(found, Home) else None
