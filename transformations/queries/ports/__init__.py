"""Where a program names a port of its board: constants, masks, macros, register bits, calls.

`ports` is the question that rules ask; the other modules find one kind of place each.
Imports `flows`, `macros`, `constants` and the modules of `queries`; plans and rules may import it.
"""
