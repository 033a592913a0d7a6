#include "simpletools.h"
#define MYHUB __attribute__((section(".hub")))
__attribute__((section(".hub"))) int n = 3;
int a __attribute__((section(".hub"), aligned(4))) = 2, b = 4;
MYHUB int m = 5;
static int k[2] __attribute((__section__(".cogdata"))) = {1,2};
void f(void) __attribute__((section(".hubtext")));
void f(void){ high(1);}
__attribute__((noinline, section(".hubtext"))) int tw(int i) { pause(1); return 2*i; }
int main(){ static int z __attribute__((section(".hub"))) = 3; f(); high(0); pause(tw(n)+a+b+m+k[0]+z); }
