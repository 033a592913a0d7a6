#include "simpletools.h"
int started;
__attribute__((constructor)) void first(void) { started += 40000;
  pause(20); }
static void __attribute__((constructor)) second() { started *= 2; }
void third(void) __attribute__((__constructor__));
void third(void) { started++; }
int main() { printf("%d\n", started);
  return 0; }
