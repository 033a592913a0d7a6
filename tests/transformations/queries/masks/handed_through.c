// ports 5
#include "simpletools.h"
int main(void) {
  unsigned a, b, c, d, e, f, g, h, i, j, k, l, m;
  a = 1 << 5;
  b = a | a, b = a; c = b | b, c = b; d = c | c, d = c; e = d | d, e = d;
  f = e | e, f = e; g = f | f, g = f; h = g | g, h = g; i = h | h, i = h;
  j = i | i, j = i; k = j | j, k = j; l = k | k, l = k; m = l | l, m = l;
  DIRA |= m;
  while (1) { OUTA ^= m; OUTA &= ~m; pause(100); }
}
