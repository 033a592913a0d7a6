#include "simpletools.h"
class Lamp{public: static void on(int p){high(p);}};
int main(){while(1){Lamp::on(8);pause(100);}}
