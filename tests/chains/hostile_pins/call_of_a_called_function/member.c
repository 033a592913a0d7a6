#include "simpletools.h"
struct lamp { void (*on)(int); };
static struct lamp lamps[] = {{high}, {low}};
static struct lamp *get(int which) { return &lamps[which]; }
int main(void) {
  get(0)->on(3);
  pause(400);
  get(1)->on(3);
  high(4); pause(100); low(4);
  while (1) pause(100);
}
