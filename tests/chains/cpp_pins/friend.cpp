#include "simpletools.h"
class Led{int pin=8;friend void on(Led&);};
void on(Led&l){high(l.pin);}
Led l;
int main(){while(1){on(l);pause(100);}}
