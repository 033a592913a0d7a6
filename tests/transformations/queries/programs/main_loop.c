#include "simpletools.h"
#define SHOW print("%d", shown)
int global;
static void worker(void *par);
unsigned int stack[44];
int main(int argc, char *argv[])
{
  int used = 1, unused = 2, shadowed = 3;
  int shown = 4, later;
  fdserial *term = fdserial_open(31, 30, 0, 115200);
  cogstart(&worker, NULL, stack, sizeof(stack));
  cog_run(worker, 10);
  while (1)
  {
    int shadowed = 5;
    SHOW;
    later = used + shadowed;
    switch (later) { case 1: break; }
    for (;;) { break; }
    if (later > 4) break;
    if (global) return 1;
    pause(ms + CNT * 0);
  }
  strlen("after");
  return 0;
}
static void worker(void *par) { while (1) { waitcnt(CLKFREQ + CNT); DIRA |= 1 << 3; own(1); } }
int high(int pin) { return pin; }
void caller(int pause) { high(pause); int CLKFREQ = 3; low(CLKFREQ); nowhere("%d", 1); }
