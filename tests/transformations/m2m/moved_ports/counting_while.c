// expect D9=1 D8=1 D7=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

int main() { int i = 0; while (i < 3) { high(i); pause(2); low(i); i += 1; } while(1); }
