// expect D9=1 D8=1 D7=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

const int steps[] = { 1, 2, 4 };
int main() { DIRA |= 7; for (int i = 0; i < 3; i++) { OUTA = (OUTA & ~7) | steps[i]; pause(3); } OUTA &= ~7; while(1); }
