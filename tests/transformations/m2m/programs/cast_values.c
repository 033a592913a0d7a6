#include "simpletools.h"
typedef struct { int level; } Cell;
char pool[64];
#define CELL(n) ((void *)(pool + (n)))
int main(void) {
  Cell *first = CELL(0);
  Cell *second = CELL(8) ;
  unsigned char *third = (pool + 16), *fourth = CELL(24); // both get a cast
  while (1) { pause(100); first->level = second->level + *third + *fourth; }
}
