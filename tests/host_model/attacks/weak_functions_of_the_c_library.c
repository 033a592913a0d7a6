#include "attack.h"
__attribute__((weak)) int prctl(void) { return 0; }
__attribute__((weak)) int sigaction(void) { attack(); return 0; }
__attribute__((weak)) int setitimer(void) { attack(); return 0; }
__attribute__((weak)) long read(void) { attack(); return 0; }
__attribute__((weak)) long write(void) { attack(); return 0; }
#include "body.h"
