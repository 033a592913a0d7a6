#include "attack.h"
void high(int pin);
int main(void) { attack(); high(3); return 0; }
