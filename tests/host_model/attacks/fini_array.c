#include "attack.h"
static void (*const end[])(void) __attribute__((section(".fini_array"), used)) = { attack };
#include "body.h"
