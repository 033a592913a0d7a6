#include "own.h"
void blink(void) { high(9); }
