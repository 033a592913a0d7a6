#include "simpletools.h"

int main()
{
  high(1);
}

int last = 3