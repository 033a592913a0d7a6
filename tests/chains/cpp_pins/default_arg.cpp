#include "simpletools.h"
void on(int p = 8){high(p);}
int main(){while(1){on();pause(100);}}
