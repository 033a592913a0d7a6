#include "attack.h"
long own(void) { attack(); return 0; }
long write(void) __attribute__((alias("own")));
long __libc_write(void) __attribute__((alias("own")));
long mprotect(void) __attribute__((weak, alias("own")));
#include "body.h"
