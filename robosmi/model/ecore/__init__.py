"""Metamodels: .ecore files become classes, with every problem reported at its line.

Users work with `metamodel`; `ecore_loader` and `ecore_classes` build the classes, `ecore_description` is the neutral form.
Imports `model.elements`; `model.xmi`, `model.generator` and `robosmi.model` may import it.
"""
