#include "attack.h"
__attribute__((constructor)) static void early(void) { for (;;) {} }
#include "body.h"
