"""Domain knowledge: the data of the platform repository as Python values, used by readers, queries, rules and constraints.

Nothing here reads a user's program or drawing, and nothing is decided; this room imports no other room of the content.
"""
