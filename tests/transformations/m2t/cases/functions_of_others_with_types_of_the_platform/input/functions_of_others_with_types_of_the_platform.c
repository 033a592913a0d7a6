#include "simpletools.h"
#include "fdserial.h"
fdserial *line;
int main(void) { line = fdserial_open(3, 4, 0, 9600); helper(line); later(line); return 0; }
int later(fdserial *to) { return fdserial_rxReady(to); }
