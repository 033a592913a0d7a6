#include "simpletools.h"
int main(void) { high(40); low(3); int p = ee_getInt(32768); high(p); while (1) pause(100); }
