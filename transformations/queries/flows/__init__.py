"""Where values and calls go: flows of values, pointers, call graph, uses of pins, cores.

`flow_reader` builds the flows of a program once; the other modules ask them.
Imports `programs`, `macros` and the modules of `queries`; everything above may import it.
"""
