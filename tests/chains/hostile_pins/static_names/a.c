#include "simpletools.h"
void b(void);
static void on(int p) { high(p); }
int main(void) { on(3); b(); while(1) pause(1); }
