#include "simpletools.h"
#define LED 26
#define ON() high(LED)
#define HIGH_ALIAS high
#define TWICE(x) ((x) + (x))
#define NOTHING
int main() { ON(); HIGH_ALIAS(LED); NOTHING (3); return TWICE(input(4)); }
/* expect: high high input input */
