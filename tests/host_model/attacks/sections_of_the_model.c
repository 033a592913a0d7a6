#include "attack.h"
static void (*const start)(void) __attribute__((section("program_setup"), used)) = attack;
static char data[64] __attribute__((section("program_data"), used)) = "not of zeros";
__attribute__((section("program_text"))) void own(void) { attack(); }
#include "body.h"
