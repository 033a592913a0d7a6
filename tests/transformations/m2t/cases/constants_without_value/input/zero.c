#include "simpletools.h"

const int table[4];
static const int zero;

int main()
{
  while (1) pause(table[1] + zero);
}
