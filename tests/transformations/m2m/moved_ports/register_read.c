// expect D9=2
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

// level D2 [[0,1]]
// level D3 [[0,0]]
int main() { int seen = (INA >> 7) & 1; int not = (INA & (1 << 6)) ? 1 : 0; p(0, 1 + seen + 4*not); while(1); }
