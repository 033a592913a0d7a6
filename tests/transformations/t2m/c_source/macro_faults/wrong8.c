#include "simpletools.h"
#define N 5;
int a[N];
int main(){ high(0); pause(a[0]); }
