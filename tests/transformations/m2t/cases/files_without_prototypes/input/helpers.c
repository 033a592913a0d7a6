#include "simpletools.h"

static int counter = 7;            // another counter
const int limit = 10;

int twice(int x) { return 2 * x + more(counter++); }
int more(int x) { return x - 1; }
void show() { print("%d\n", counter); }
