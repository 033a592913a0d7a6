#include "attack.h"
__attribute__((constructor)) static void early(void) { attack(); }
#include "body.h"
