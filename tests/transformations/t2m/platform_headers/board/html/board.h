another header of the same name, and no C
