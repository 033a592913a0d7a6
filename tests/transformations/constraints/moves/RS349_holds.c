#include "simpletools.h"
#include <stdlib.h>
#include <string.h>
char *names[3];
int main(void) {
  int n = sizeof(long) + sizeof(short) + sizeof('a') + sizeof(double);
  int count = sizeof(names) / sizeof(names[0]) + sizeof names / sizeof(char *);
  char **copy = malloc(count * sizeof(char *));
  memset(names, 0, sizeof(names));
  print("%d\n", n + count + (copy != 0));
}
