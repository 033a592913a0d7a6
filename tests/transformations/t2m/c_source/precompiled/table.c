#include "board.h"
#define PIN(n) n,
int pins[] = {
#include "pins.def"
};
int main() { return pins[0]; }
