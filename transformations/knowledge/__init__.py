"""What is known: the data of the platform repository as Python values, asked by readers, queries, rules and constraints alike.

Nothing is read from a user's program or drawing here, and nothing is decided; this room imports no other of the content.
"""
