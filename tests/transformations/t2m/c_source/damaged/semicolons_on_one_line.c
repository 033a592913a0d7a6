#include "simpletools.h"

int main()
{
  high(1) pause(2) low(3);
}
