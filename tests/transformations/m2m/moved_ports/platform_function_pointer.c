// expect D9=1 D8=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

void (*act)(int) = high;
void (*off)(int) = &low;
int main() { act(0); pause(2); off(0); p(1, 1); while(1); }
