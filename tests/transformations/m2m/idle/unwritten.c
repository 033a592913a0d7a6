#include "simpletools.h"

int main()
{
  while (1)
    if (keys_read())
      high(3);
}
