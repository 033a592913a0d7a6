// expect D9=1 D8=2
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

#define PINS { 0, 1 }
#define COUNT 2
int pins[COUNT] = PINS;
int main() { for (int i = 0; i < COUNT; i++) p(pins[i], i + 1); while(1); }
