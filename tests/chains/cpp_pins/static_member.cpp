#include "simpletools.h"
class Lamp{public: static const int pin = 8;
void on(){high(pin);}};
Lamp lamp;
int main(){while(1){lamp.on();high(Lamp::pin);pause(100);}}
