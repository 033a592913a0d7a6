// expect D9=1 D8=1
#include "simpletools.h"
union { int one; int other; } both;
void pulse(int pin) { high(pin); pause(2); low(pin); pause(2); }

int main() { both.one = 0; pulse(both.one); both.other = 1; pulse(both.one); while (1); }
