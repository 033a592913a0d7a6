#include "simpletools.h"
static volatile int ready;
void measure(void *par) { pause(100); ready = 1; }

int main(void)
{
  cognew(measure, 0);
  while (!ready);  // RS323: while (!ready);
  while (ready == 1) { pause(10); }  // RS323: while (ready == 1) { pause(10); }
}
