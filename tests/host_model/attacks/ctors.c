#include "attack.h"
static void (*const start[])(void) __attribute__((section(".ctors.65535"), used)) = { attack };
#include "body.h"
