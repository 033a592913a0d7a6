/* A cog takes memory of the heap, and so does main in turn with it. */
#include "simpletools.h"
#include <stdlib.h>

volatile int from_cog, from_main;

void take() { while (1) { char *memory = malloc(20); if (memory) { memory[19] = 1; from_cog++; } pause(10); free(memory); } }

int main()
{
  cog_run(take, 128);
  for (int i = 0; i < 5; i++) { char *memory = malloc(30); if (memory) from_main++; pause(10); free(memory); }
  print("%d %d\n", from_main, from_cog >= 4);
  while (1) pause(1);
}
