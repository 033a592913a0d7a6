#include "simpletools.h"
void blink(void);
int main() { while (1) { high(5); blink(); pause(100); low(5); } }
