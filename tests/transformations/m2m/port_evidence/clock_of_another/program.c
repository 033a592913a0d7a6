#include "simpletools.h"
const int clock = 5, bits = 6;
int main() { shift_out(bits, clock, 0, 8, 3); }
