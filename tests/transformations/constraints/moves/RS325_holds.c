#include "simpletools.h"
/* A function of the program with such a name starts nothing. */
void cog_run(void (*code)(void *), int stack) { code(0); }
void blink(void *par) { toggle(26); }

int main(void)
{
  cog_run(blink, 128);
}
