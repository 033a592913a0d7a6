#include "simpletools.h"
class Lamp{public: void on(int p){high(p);}};
Lamp lamp;
int main(){Lamp*l=&lamp;while(1){l->on(8);pause(100);}}
