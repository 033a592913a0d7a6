"""Elements in memory: features, values, containment, the strict base class of generated classes, the `Model` interface.

`ecore` gives types to pyecore, `pyecore_internals` alone uses its private names, `driver` is the interface of all technologies.
Imports only the foundation; all other rooms of `robosmi.model` and everything above may import it.
"""
