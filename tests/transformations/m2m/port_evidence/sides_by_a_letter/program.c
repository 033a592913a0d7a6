#include "simpletools.h"

int eyeLeft = 7, eyeRight = 8;

int main()
{
  while (1)
  {
    if (input(eyeLeft)) print("left");
    if (input(eyeRight)) print("right");
    pause(10);
  }
}
