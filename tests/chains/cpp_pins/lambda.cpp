#include "simpletools.h"
int main(){auto on=[](int p){high(p);};
while(1){on(8);pause(100);}}
