#include "simpletools.h"
#include "badgetools.h"

int main()
{
  badge_setup();
  cursor(0, 0);
  oledprint("on %d", 1);
  launch_rocket(3);
}
