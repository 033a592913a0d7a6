// expect D9=1 D8=2
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

void go(void (*f)(int, int), int pin, int n) { f(pin, n); }
int main() { go(p, 0, 1); go(&p, 1, 2); while(1); }
