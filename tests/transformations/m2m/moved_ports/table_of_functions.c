// expect D9=1 D8=2
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

void one(int pin) { p(pin, 1); }
void two(int pin) { p(pin, 2); }
void (*table[2])(int) = { one, &two };
int main() { table[0](0); (*table[1])(1); while(1); }
