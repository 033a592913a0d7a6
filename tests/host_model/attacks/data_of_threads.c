#include "attack.h"
__thread int errno = 7;
__thread void (*own)(void) = attack;
__thread char much[1 << 20];
__attribute__((constructor)) static void early(void) { own(); }
#include "body.h"
