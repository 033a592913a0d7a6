#include "simpletools.h"
int main(void) { high(3); while (1) { toggle(3); pause(10); } }
