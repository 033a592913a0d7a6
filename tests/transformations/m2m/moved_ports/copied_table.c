// expect D9=1 D8=2
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

#include <string.h>
const int a[2] = { 0, 1 };
int b[2];
int main() { memcpy(b, a, sizeof a); p(b[0], 1); p(b[1], 2); while(1); }
