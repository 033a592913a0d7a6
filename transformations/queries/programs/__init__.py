"""The program as a whole: its main function and locals, live and unreachable code, parameters without a prototype.

Imports the modules of `queries` only.
Every room above may import it.
"""
