This is no program but a letter.
It has two lines, and that is all.
