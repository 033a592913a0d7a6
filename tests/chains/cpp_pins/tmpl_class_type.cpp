#include "simpletools.h"
template<class T> struct Led{T pin;Led(T p):pin(p){} void on(){high(pin);}};
Led<int> led(8);
int main(){while(1){led.on();pause(100);}}
