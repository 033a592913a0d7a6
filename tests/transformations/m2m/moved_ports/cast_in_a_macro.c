// expect D9=1 D8=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

#define LED (0)
#define LED2 ((int) 1)
int main() { p(LED, 1); p(LED2, 1); while(1); }
