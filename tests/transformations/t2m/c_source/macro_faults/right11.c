#include "simpletools.h"
#define WAIT(x) pause(x);
int main(){ WAIT(5) high(0); WAIT(10); }
