// expect D9=1 D7=3
// bind P0=D9
// bind P2=D7
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

int main() { char s[] = "02"; p(s[0] - '0', 1); p(s[1] - '0', 3); while(1); }
