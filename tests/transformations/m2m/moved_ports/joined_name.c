// expect D9=1 D8=2
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

#define PIN_A 0
#define PIN_B 1
#define PIN(x) PIN_##x
int main() { p(PIN(A), 1); p(PIN(B), 2); while(1); }
