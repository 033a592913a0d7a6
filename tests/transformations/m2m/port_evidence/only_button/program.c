#include "simpletools.h"
int main() { while (1) print("%d", input(3)); }
