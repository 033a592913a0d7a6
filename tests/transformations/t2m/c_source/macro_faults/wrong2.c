#include "simpletools.h"
#define PI 3.14;
int main(){ int n=0; n = PI*2; high(0); pause(n); }
