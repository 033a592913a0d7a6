// expect D9=1 D8=1 D7=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

void all(int pin) { if (pin > 2) return; high(pin); pause(2); low(pin); all(pin + 1); }
int main() { all(0); while(1); }
