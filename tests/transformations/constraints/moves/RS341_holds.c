#include "simpletools.h"
/* As many arguments as are taken, or more; a list that goes on as it likes; pointers of which nothing is known. */
struct mood { int (*passive)(); void (*active)(); };
int wait(int ms) { pause(ms); return ms; }
void stop(void) { pause(1); }
struct mood calm = { wait, stop };
void (*unknown)();

int main(void)
{
  calm.passive(3);
  calm.active();
  calm.active(4);
  print("now\n");
  if (unknown) unknown();
}
