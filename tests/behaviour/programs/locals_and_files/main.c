#include <stdio.h>
#include "plan.h"
int main(void) {
  float plan[2] = {1.5f, 2.5f};
  unsigned char serial[3] = {1, 2, 3}, shared = 7;
  int inner = 70000;
  make(plan, serial);
  while (1) {
    printf("%d %d %d %d %d %d\n", (int)(10 * plan[0]), (int)(10 * plan[1]), serial[0], shared, inner, other());
    plan[0] += 1;
    serial[0]++;
    shared++;
    inner += 40000;
  }
}
