"""XMI and JSON: models are read with lines for every problem, and written as EMF and EMF-JSON write them.

`xmi_reader`, `xmi_writer` and `json_writer` are the ways in; the other modules serve them.
Imports `model.elements` and `model.ecore`; the modules of `robosmi.model` may import it.
"""
