// expect D8=1 D7=1
// Functions of the program that are called through pointers take no pins: `void *` and a cog's code are none.
#include "simpletools.h"

#define LAMP 1

static int steps;
static void step(void *data) { steps++; }
static void wait(void *data) { pause(1); }
static void on_another_core(void *par) { while (1) pause(5); }

static void (*const parts[])(void *data) = {step, wait};
static void (*const toggle_to[])(int pin) = {low, high};

static unsigned int stack[60];

int main(void)
{
  cogstart(on_another_core, 0, stack, sizeof(stack));
  parts[steps & 1](0);
  toggle_to[1](LAMP);
  pause(2);
  toggle_to[0](LAMP);
  high(2);
}
