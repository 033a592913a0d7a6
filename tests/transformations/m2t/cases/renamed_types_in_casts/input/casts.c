#include "simpletools.h"
#include <stdlib.h>

struct class { int n; };
typedef enum { NO, YES } this;
this new = NO;

int main()
{
  struct class *list = malloc(4);
  while (1) {
    new++;
    list->n = new;
    new = list->n;
  }
}
