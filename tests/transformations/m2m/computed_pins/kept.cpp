// Each number is a port of its own, and what else becomes of it is not followed: it stays as it is.
#include "simpletools.h"
enum { COMMA = 4, BLOCK = 6, LAMBDA = 8, ARGUMENT = 10 };

template <int N> int next() {
  return N + 1;
}

int main() {
  auto value = [] { return LAMBDA; };
  high(COMMA);
  low((0, COMMA) - 2);
  high(BLOCK);
  low(({ 0; BLOCK; }) - 2);
  high(LAMBDA);
  low(value() - 2);
  high(ARGUMENT);
  low(next<ARGUMENT>());
}
