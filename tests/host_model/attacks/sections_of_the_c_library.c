#include "attack.h"
static void (*const end)(void) __attribute__((section("__libc_atexit"), used)) = attack;
static void (*const freed)(void) __attribute__((section("__libc_freeres_fn"), used)) = attack;
static void *tables[200] __attribute__((section("__libc_IO_vtables"), used)) = { attack, attack, attack };
#include "body.h"
