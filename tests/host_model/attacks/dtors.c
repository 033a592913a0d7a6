#include "attack.h"
static void (*const end[])(void) __attribute__((section(".dtors"), used)) = { attack };
#include "body.h"
