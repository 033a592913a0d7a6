"""Toolchains described by data: boards, sketches, compilers, build records, messages of compilers.

`toolchain` reads a toolchain's data, `build` runs it, `processes` starts programs within limits.
Imports the foundation and `robosmi.generate`; the other rooms of `robosmi.verify` may import it.
"""
