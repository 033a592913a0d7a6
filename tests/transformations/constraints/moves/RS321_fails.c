#include "simpletools.h"
void blink(void *par) { while (1) toggle(26); }

int main(void)
{
  cog_run(blink, 128);  // RS321: cog_run(blink, 128)
  while (1) pause(10);
}
