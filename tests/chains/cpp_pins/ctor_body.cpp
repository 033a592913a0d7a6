#include "simpletools.h"
const int LED=8;
class Lamp{public: Lamp(int p){pin=p;}
void on(){high(pin);}
int pin;};
Lamp lamp(LED);
int main(){while(1){lamp.on();pause(100);}}
