// expect D9=1 D8=2
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

// bind P1=D8
int main() { int pin = 0; p(pin, 1); pin++; p(pin, 2); while(1); }
