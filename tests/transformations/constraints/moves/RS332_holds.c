#include "simpletools.h"
#include <stdlib.h>

int *kept;

int sum(int count) {
  int *some = malloc(count * sizeof(int));
  some[0] = count;
  int first = some[0];
  free(some);
  return first;
}

int main() {
  kept = malloc(40);
  while (1) {
    char *line = malloc(40);
    line[0] = input(3);
    kept[0] = sum(line[0]);
    free(line);
    pause(10);
  }
}
