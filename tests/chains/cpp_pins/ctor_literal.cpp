#include "simpletools.h"
class Lamp{public: Lamp(int p):pin(p){}
void on(){high(pin);}
int pin;};
int main(){Lamp lamp(8);
while(1){lamp.on();pause(100);}}
