#include "attack.h"
__attribute__((constructor(101))) static void early(void) { attack(); }
#include "body.h"
