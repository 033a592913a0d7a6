#include "simpletools.h"
struct Led{int pin;explicit Led(int p):pin{p}{}void on(){high(pin);}};
int main(){while(1){Led(8).on();pause(100);}}
