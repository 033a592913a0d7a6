#include "simpletools.h"

struct config { int pin; int speed; };
int table[4] = { [2] = 5 };
struct config left = { .speed = 24, .pin = 3 };

int main()
{
  while (1) pause(table[2] + left.speed);
}
