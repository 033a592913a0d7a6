#include "simpletools.h"

int main()
{
  print("ιθ")
  /* ό */ high(1)
  low(2);
}
