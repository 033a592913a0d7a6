#include "simpletools.h"
class Lamp{public: void on(int p){high(p);}};
Lamp lamp;
int main(){while(1){lamp.on(8);pause(100);}}
