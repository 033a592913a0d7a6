this is no C++: examples are not compiled
