#include "simpletools.h"
#include "badgetools.h"
#include "sys/unknown_thing.h"

int main() {
  badge_setup();
  text_size(LARGE);
  oledprint("Hello");
  gauge_open(3);
  while (1) {
    pause(100);
    led(1, 1);
  }
}
