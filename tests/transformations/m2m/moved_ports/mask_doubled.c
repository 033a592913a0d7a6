// expect D9=1 D8=1 D7=1 D6=1
#include "simpletools.h"
int main() { DIRA |= 0xF; for (int m = 1; m < 0x10; m += m) { OUTA |= m; pause(1); OUTA &= ~m; } while (1); }
