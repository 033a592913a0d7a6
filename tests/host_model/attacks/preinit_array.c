#include "attack.h"
static void (*const start[])(void) __attribute__((section(".preinit_array"), used)) = { attack };
#include "body.h"
