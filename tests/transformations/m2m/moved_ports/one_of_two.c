// expect D9=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

// level D2 [[0,1]]
int main() { int pin; if (input(7)) pin = 0; else pin = 1; p(pin, 1); while(1); }
