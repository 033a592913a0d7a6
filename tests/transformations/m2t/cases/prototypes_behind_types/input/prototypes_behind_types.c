#include "simpletools.h"
#include "points.h"

void first(void) { low(1); }

typedef struct { int left, right; } Pair;

void second(void) {
  Pair pair = {1, 2};
  third(&pair);
}

int third(Pair *pair) {
  return pair->left + pair->right;
}

int main() {
  first();
  second();
  corners();
}
