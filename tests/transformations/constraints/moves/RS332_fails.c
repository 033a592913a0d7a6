#include "simpletools.h"
#include <stdlib.h>

char *copied(const char *text) {
  char *copy = malloc(20);  // RS332: malloc(20)
  strcpy(copy, text);
  return copy;
}

int main() {
  while (1) {
    int *many = calloc(10, sizeof(int));  // RS332: calloc(10, sizeof(int))
    many[0] = input(3);
    print("%s %d\n", copied("a"), many[0]);
    pause(10);
  }
}
