#include "simpletools.h"
#include "beacon.h"

int main()
{
  while(1)
  {
    beacon_flash(9, 3);
    beacon_sound(10);
    pause(200);
  }
}
