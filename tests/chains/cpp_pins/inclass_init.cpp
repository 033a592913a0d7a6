#include "simpletools.h"
struct Led{int pin=8;void on(){high(pin);}};
Led l;
int main(){while(1){l.on();pause(100);}}
