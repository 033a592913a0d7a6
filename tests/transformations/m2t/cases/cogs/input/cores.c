#include "simpletools.h"

volatile int shared;
unsigned int stack[40 + 25];

void worker(void *par)
{
  while (1) {
    shared++;
    pause(10);
  }
}

void second(void) { while (1) low(3); }

int main()
{
  int cog = cogstart(&worker, NULL, stack, sizeof(stack));
  int *handle = cog_run(second, 10);
  cog_end(handle);
  while (1) {
    print("%d %d\n", shared, cog);
    pause(500);
  }
}
