// expect D9=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

unsigned int stack[80];
void blink(void *par) { int pin = *(int *)par; p(pin, 1); while (1) pause(100); }
int main() { int led = 0; cogstart(blink, &led, stack, sizeof stack); while(1) pause(50); }
