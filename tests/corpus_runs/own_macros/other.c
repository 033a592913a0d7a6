#include "simpletools.h"

void other(void) { low(9); }
