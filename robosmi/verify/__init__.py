"""Checks generated programs: compiling with the real toolchain, and comparing two runs.

The modules here run tools and read their output. Tools, boards, flags, messages and libraries are data in `platform_repo`; no
module of this package names one. Import the modules: `verify.toolchain` (compile), `cli.commands.doctor` (what is installed).
"""
