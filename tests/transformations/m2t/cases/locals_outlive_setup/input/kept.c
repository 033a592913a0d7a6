#include "simpletools.h"

int *kept;
char *line;

int main()
{
  int value = 4;
  char buffer[20];
  kept = &value;
  line = buffer;
  while (1) {
    *kept = *kept + 1;
    line[0] = 'x';
    pause(*kept);
  }
}
