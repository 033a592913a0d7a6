#include "simpletools.h"
template<int P> void on(){high(P);}
int main(){while(1){on<8>();pause(100);}}
