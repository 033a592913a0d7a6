#include "simpletools.h"

int and, or;
int not(int xor) { return !xor; }

int main()
{
  while (1) {
    and = not(or);
    pause(and);
  }
}
