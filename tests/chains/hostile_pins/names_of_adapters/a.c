#include "simpletools.h"
void b(void);
void c(void);
int main(void) { high(5); low(5); b(); c(); while (1) pause(1); }
