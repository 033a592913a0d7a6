"""C text to syntax trees with libclang: calls of the parser, preprocessing, recovery from errors, bounds of input.

`translation_unit` parses one file, `clang` gives types to libclang's Python binding.
Imports queries only; the modules of `c_source` may import it.
"""
