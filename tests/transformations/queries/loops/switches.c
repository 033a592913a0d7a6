// 10 to 200
#include "simpletools.h"

int turn(int way)
{
  switch (way)
  {
    case 1:
    case 2:
      pause(30);
      pause(20);
      break;
    case 3:
    {
      pause(40);
      return 1;
    }
    case 4:
      if (input(7))
      {
        pause(25);
        break;
      }
      pause(60);          // falls into the next
    case 5:
      pause(130);
      break;
    default:
      break;
  }
  return 0;
}

int main(void)
{
  while (1)
  {
    toggle(26);
    pause(10);
    turn(input(8) * 3 + input(9));
  }
}
