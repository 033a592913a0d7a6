#include "simpletools.h"
struct S{int pin;
int ms;};
S s={8,100};
int main(){high(s.pin);while(1)pause(100);}
