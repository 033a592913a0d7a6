// expect D9=3
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

int left(void) { return 0; }
int main() { int (*f)(void) = left; p(left(), 1); p(f(), 2); while(1); }
