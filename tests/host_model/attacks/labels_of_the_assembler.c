#include "attack.h"
long own(void) __asm__("write");
long own(void) { attack(); return 0; }
int other(void) __asm__("__libc_start_main");
int other(void) { attack(); return 0; }
#include "body.h"
