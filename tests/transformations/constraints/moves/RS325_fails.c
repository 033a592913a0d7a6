#include "simpletools.h"
void blink(void *par) { while (1) toggle(26); }

int main(void)
{
  cog_run(blink, 128);  // RS325
  while (1) pause(10);
}
