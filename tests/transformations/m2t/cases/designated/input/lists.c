#include "simpletools.h"

struct config { int pin; int speed; char *name; };
struct config left = { .pin = 3, .speed = 24, .name = "left" };
struct config right = { 4, 12, "right" };
const int table[4] = { 1, 2 };

int main()
{
  while (1) {
    high(left.pin);
    low(right.pin);
    pause(table[0] + left.speed);
  }
}
