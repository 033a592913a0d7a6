#include "simpletools.h"
struct Led{int pin;Led(int p):pin{p}{}void on(){high(pin);}};
struct Bot{Led led{8};void go(){led.on();}};
Bot b;
int main(){while(1){b.go();pause(100);}}
