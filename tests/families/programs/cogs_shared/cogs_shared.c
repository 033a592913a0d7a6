/* A cog measures a distance while main shows the last one. */
#include "simpletools.h"
#include "ping.h"

static volatile int cm = -1;
static int stack[60];

void look(void *par) {
  int *where = (int *)par;
  while (1) {
    cm = ping_cm(*where);
    pause(50);
  }
}

int eye = 15;

int main() {
  int cog = cogstart(look, &eye, stack, sizeof(stack));
  print("%d\n", cog >= 0);
  while (cm < 0)
    ;
  print("%d\n", cm);
  pause(300);
  print("%d\n", cm);
  cogstop(cog);
}
