#include "mv.h"
void move(void) { left += 10; right += 20; shared_one += 30; *pointer += 40; }
