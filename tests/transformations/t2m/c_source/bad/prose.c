The quick brown fox jumps over the lazy dog. It is no program.
