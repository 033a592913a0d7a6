"""The largest depth of the stack, from the machine code of an AVR program.

`machine_code` decodes, `machine_stack` bounds.
Imports nothing of `verification`; the registry offers it as the query `stack_bound`.
"""
