#include "simpletools.h"
#define VA(...) high(__VA_ARGS__)
#define GN(args...) low(args)
#define THROUGH(...) VA(__VA_ARGS__)
#define TWO(...) set_output(__VA_ARGS__)
#define ALWAYS VA(7)
#define SOMETIMES TWO(6, 1)

int main() {
  int i = 3;
  VA(8);
  GN(9);
  THROUGH(10);
  TWO(11, 1);
  TWO(i + 1, 0);
  ALWAYS;
  SOMETIMES;
  while (1);
}
