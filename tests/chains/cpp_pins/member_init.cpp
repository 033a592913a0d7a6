#include "simpletools.h"
class Lamp{public: int pin = 8;
void on(){high(pin);}};
Lamp lamp;
int main(){while(1){lamp.on();pause(100);}}
