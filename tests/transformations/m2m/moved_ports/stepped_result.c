// expect D9=1 D8=2
// bind P1=D8
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

int next() { static int pin = 0; return pin++; }
int main() { p(next(), 1); p(next(), 2); while(1); }
