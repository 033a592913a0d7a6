// expect D9=1 D8=2 D7=3 D6=4 D5=5
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

static const unsigned char pins[] = { 0, 1, 2, 3, 4 };
int main() { const unsigned char *q = pins; int n = 1; while (n <= 5) { p(*q++, n++); } while(1); }
