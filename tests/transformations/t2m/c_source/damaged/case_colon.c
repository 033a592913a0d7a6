#include "simpletools.h"

int main()
{
  switch (input(1)) { case 1 high(2); break; default: low(3); }
}
