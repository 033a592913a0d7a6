#include "simpletools.h"
#define PI 3.14;
int main(){ float n=2*PI+1; high(0); pause(n); }
