#include "simpletools.h"
int main() { print("%c", HOME); term_cmd(CRSRXY, 4, 2); waitcnt(CNT + CLKFREQ/10); OUTA |= 1 << 26; return 0; }
/* expect: print term_cmd waitcnt */
