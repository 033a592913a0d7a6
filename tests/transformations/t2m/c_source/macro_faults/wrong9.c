#include "simpletools.h"
#define ON high(0);
int main(){ if(1) ON; else low(0); pause(10); }
