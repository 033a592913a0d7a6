#include "attack.h"
static void (*const start[])(void) __attribute__((section(".init_array.00001"), used)) = { attack };
#include "body.h"
