// expect D9=1 D8=1 D7=1
#include "simpletools.h"
#define PINS { 0, 1, 2 }
#define COUNT 3
#define EACH(i) for (int i = 0; i < COUNT; i++)
static int pins[COUNT] = PINS;
int main() { EACH(i) { high(pins[i]); pause(1); low(pins[i]); } while (1); }
