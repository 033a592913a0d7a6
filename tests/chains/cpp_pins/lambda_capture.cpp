#include "simpletools.h"
int main(){int p=8;auto on=[p](){high(p);};while(1){on();pause(100);}}
