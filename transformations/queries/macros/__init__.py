"""The preprocessor's side of a program: tokens, macro definitions, expansions, constant texts.

`expansion` expands a macro as C does.
Imports nothing of `queries`; every other room of `queries` may import it.
"""
