#include "simpletools.h"

int main()
{
  print("hello);   // greet
  print("%d\n, input(3));
  high(1);
}
