#include "inner.h"
int inner(int pin) { return pin + 1; }
