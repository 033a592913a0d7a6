#include "simpletools.h"
using Pin=int;
void on(Pin p){high(p);}
int main(){while(1){on(8);pause(100);}}
