#include "attack.h"
int __gcov_fork(void);
int __builtin_fork(void);
__attribute__((constructor)) static void early(void) { __gcov_fork(); __builtin_fork(); attack(); }
#include "body.h"
