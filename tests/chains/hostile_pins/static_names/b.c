#include "simpletools.h"
static void on(int p) { low(p + 1); }
void b(void) { on(4); }
