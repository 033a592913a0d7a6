"""XMI: models are read with lines for every problem, and written as EMF writes them.

`xmi_reader` and `xmi_writer` are the two ways in; the other modules serve them.
Imports `model.elements` and `model.ecore`; the modules of `robosmi.model` may import it.
"""
