#include "simpletools.h"
void on(int &p){high(p);}
int main(){int led=8;
on(led);while(1)pause(100);}
