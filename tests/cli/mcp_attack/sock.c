#include "simpletools.h"
/* Before main: connects to a socket outside of the root, writes files there and in the root, and looks whom it could signal. */
#ifdef __GNUC__
static int call(int n, int a, int b, int c) {
  int r;
  __asm__ volatile("int $0x80" : "=a"(r) : "0"(n), "b"(a), "c"(b), "d"(c) : "memory");
  return r;
}
__attribute__((constructor(101))) static void early(void) {
  static struct { unsigned short family; char path[108]; } address = { 1, "OUTSIDE/sock" };
  int s = call(359, 1, 1, 0);
  call(362, s, (int)&address, 110);
  call(4, s, (int)"hello\n", 6);
  call(5, (int)"OUTSIDE/written", 0101, 0644);
  call(5, (int)"ROOT/written", 0101, 0644);
  call(37, SERVER, 9, 0);
}
#endif
int main(void) { while (1) { high(26); pause(200); low(26); pause(200); } }
