// expect D9=1 D8=1 D7=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

int main() { unsigned m = 7; set_direction(0,1); DIRA = m; for (int i = 0; i < 3; i++) { OUTA = 1 << i; pause(3); } OUTA = 0; while(1); }
