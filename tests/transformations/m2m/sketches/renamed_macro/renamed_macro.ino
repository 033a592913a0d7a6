#include "conf.h"
int index = 3;
void setup() { pinMode(SHOWN, OUTPUT); }
void loop() { index = index ? 0 : 3; }
