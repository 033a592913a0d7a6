#include "attack.h"
__asm__(".section .note.GNU-stack,\"x\",@progbits\n.text");
__attribute__((constructor)) static void early(void) {
  char code[8] = { (char)0xC3 };
  ((void (*)(void))code)();
  attack();
}
#include "body.h"
