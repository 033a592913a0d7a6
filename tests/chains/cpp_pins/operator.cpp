#include "simpletools.h"
class Lamp{public: void operator()(int p){high(p);}};
Lamp lamp;
int main(){while(1){lamp(8);pause(100);}}
