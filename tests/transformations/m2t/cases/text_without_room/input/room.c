#include "simpletools.h"

char code[3] = "abc";

int main()
{
  while (1) pause(code[0]);
}
