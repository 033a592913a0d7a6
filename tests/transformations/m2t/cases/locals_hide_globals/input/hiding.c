#include "simpletools.h"

int speed = 1;

void show(void) { pause(speed); }

int main()
{
  int speed = 24;
  while (1) {
    show();
    pause(speed);
  }
}
