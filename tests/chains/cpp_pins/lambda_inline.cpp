#include "simpletools.h"
int main(){while(1){[](int p){high(p);}(8);pause(100);}}
