"""The documented path of `robosmi.verify.toolchains.toolchain`."""

from robosmi.verify.toolchains.toolchain import (
    compile_sketch as compile_sketch,
)
