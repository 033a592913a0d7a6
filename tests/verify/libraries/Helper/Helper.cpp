#include "Helper.h"
#include "inner.h"
int help(int pin) { return inner(pin); }
