// bytes: 4 + 4
#include "simpletools.h"

volatile int seen;
int stack[400];

void look(void *par) {
  while (1) {
    seen = input(3);
    pause(10);
  }
}

int main() {
  int times = 0;
  cogstart(look, NULL, stack, sizeof stack);
  while (1) {
    if (seen) times++;
    pause(times);
  }
}
