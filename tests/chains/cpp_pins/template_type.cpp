#include "simpletools.h"
template<typename T> void on(T p){high(p);}
int main(){while(1){on(8);pause(100);}}
