// expect D5=1 D9=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

int main() { high(4); low(4); high(36); pause(5); low(36); DIRA |= 1 << 36; p(0, 1); while(1); }
