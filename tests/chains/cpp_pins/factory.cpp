#include "simpletools.h"
struct Led{int pin;explicit Led(int p):pin{p}{}void on(){high(pin);}};
Led make(int p){return Led(p);}
int main(){Led l=make(8);while(1){l.on();pause(100);}}
