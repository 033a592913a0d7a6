#include "attack.h"
long write;
int prctl;
long sigaction[64];
__attribute__((constructor(200))) static void early(void) { attack(); }
#include "body.h"
