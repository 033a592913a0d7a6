// expect D9=1 D8=1 D7=1 D6=1
#include "simpletools.h"
void p(int pin, int n){ for(int i=0;i<n;i++){ high(pin); pause(2); low(pin); pause(2);} }

void all(int first, int last) { for (int k = first; k <= last; k++) p(k, 1); }
int main() { all(0, 1); all(2, 3); while(1); }
