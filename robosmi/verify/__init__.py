"""Checking what was generated: a compile with the real toolchain, and comparison of two runs.

What lives here runs tools and reads what they say. Which tools, boards, flags, messages and libraries there are is data in
`platform_repo`; no module of this package names one. Import the modules: `verify.toolchain` (compile), `verify.doctor` (what
is installed).
"""
