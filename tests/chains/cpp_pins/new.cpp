#include "simpletools.h"
class Lamp{public: Lamp(int p):pin(p){}
void on(){high(pin);}
int pin;};
int main(){Lamp*l=new Lamp(8);while(1){l->on();pause(100);}}
