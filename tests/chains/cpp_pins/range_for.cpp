#include "simpletools.h"
int pins[]={8,9};
int main(){for(int p: pins) high(p);
while(1)pause(100);}
