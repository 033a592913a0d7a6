#include "attack.h"
static void work(void) {}
static void *choose(void) { attack(); return work; }
void resolved(void) __attribute__((ifunc("choose")));
void (*use)(void) = resolved;
#include "body.h"
