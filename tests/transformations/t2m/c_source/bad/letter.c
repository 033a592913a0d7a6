This is a letter, and no program.
