#include "simpletools.h"
#define LAMP 20 /* first half */ + 6

int main()
{
  while (1) toggle(LAMP);
}
