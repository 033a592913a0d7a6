#include "simpletools.h"
class Lamp{public: Lamp(int p,int q):pin(p){}
Lamp(int p):Lamp(p,1){}
void on(){high(pin);}
int pin;};
Lamp lamp(8);
int main(){while(1){lamp.on();pause(100);}}
