#include "simpletools.h"
void work(void) { toggle(2); }
