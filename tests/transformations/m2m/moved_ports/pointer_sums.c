// expect D9=1 D8=2 D7=3
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

int pins[] = { 0, 1, 2 };
int main() { int *q = pins + 1; p(*pins, 1); p(*q, 2); p(*(q + 1), 3); while(1); }
