#include "simpletools.h"

int main()
{
  int speed(int n);
  pause(speed(1));
  while (1) {
    pause(speed(2));
  }
}

int speed(int n) { return n * 2; }
