#include "simpletools.h"
class Part{public: Part(int p):pin(p){}
int pin;};
class Lamp: public Part{public: Lamp(int p):Part(p){}
void on(){high(pin);}};
Lamp lamp(8);
int main(){while(1){lamp.on();pause(100);}}
