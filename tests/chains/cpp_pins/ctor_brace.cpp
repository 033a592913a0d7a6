#include "simpletools.h"
class Lamp{public: Lamp(int p):pin(p){}
void on(){high(pin);}
int pin;};
Lamp lamp{8};
int main(){while(1){lamp.on();pause(100);}}
