"""What a program takes: memory, stack, interrupts, sizes of types, time of its loop, cores.

Sizes are in bytes of the target, times in microseconds.
Imports `plans`, `constants`, `flows` and `programs`; `reports`, rules and constraints may import it.
"""
