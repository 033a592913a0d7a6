#include "simpletools.h"
class Lamp{public: Lamp(int p=8):pin(p){}
void on(){high(pin);}
int pin;};
Lamp lamp;
int main(){while(1){lamp.on();pause(100);}}
