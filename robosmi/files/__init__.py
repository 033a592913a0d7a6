"""Files and folders that are written in one step: atomic commits, recovery after a kill, locks on output folders.

`commit` and `recovery` write a set of files all or not at all; `directory_fd` holds a folder by its descriptor.
Imports only the foundation (`robosmi.base`); `model`, `generate`, `verify`, the command line and the content import it.
"""
