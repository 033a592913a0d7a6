#include "simpletools.h"
#define PINBUTTON 3
#define redled 26
int main() { while (1) if (input(PINBUTTON)) high(redled); else low(redled); }
