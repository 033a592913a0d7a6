#include "attack.h"
__attribute__((visibility("hidden"))) long write(void) { attack(); return 0; }
__attribute__((visibility("protected"))) int sigaction(void) { attack(); return 0; }
__attribute__((visibility("internal"))) int mprotect(void) { attack(); return 0; }
#include "body.h"
