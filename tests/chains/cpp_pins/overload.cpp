#include "simpletools.h"
void on(int p){high(p);}
void on(int p,int ms){high(p);pause(ms);}
int main(){on(8);on(8,5);while(1)pause(100);}
