/* Three cogs of one function, each with a parameter and a stack of its own. */
#include "propeller.h"
#include "simpletools.h"

typedef struct { int place; int time; } blinking;

static blinking jobs[] = { { 0, 30 }, { 1, 20 }, { 2, 10 } };
static int stacks[3][64];

void light(int place)
{
  if (place == 0) high(25);
  else if (place == 1) high(26);
  else high(27);
}

void dark(int place)
{
  switch (place) {
    case 0: low(25); break;
    case 1: low(26); break;
    default: low(27);
  }
}

void blink(void *par)
{
  blinking *job = par;
  int times;
  for (times = 0; times < 4; times++)
  {
    light(job->place);
    pause(job->time);
    dark(job->place);
    pause(job->time);
  }
}

int main(void)
{
  int i, started = 0;
  for (i = 0; i < 3; i++)
    started += cogstart(blink, &jobs[i], stacks[i], sizeof(stacks[i]));
  print("%d\n", started);
  while (1) pause(1000);
}
