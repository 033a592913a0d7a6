"""Programs put on a board: uploaders described by data, serial ports.

`upload` is the command's function.
Imports `verify.toolchains`; the API imports it.
"""
