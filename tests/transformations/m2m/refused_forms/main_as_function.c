#include "simpletools.h"
int main(void);
void again(void){ main(); }
int (*start)(void) = main;
int main(void){ high(0); pause(30); if (input(1)) again(); while(1) pause(100); }
