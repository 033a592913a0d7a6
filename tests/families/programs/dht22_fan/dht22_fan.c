/* A fan that runs while it is humid, by a sensor that is read in a loop. */
#include "simpletools.h"
#include "dht22.h"

#define SENSOR 5
#define FAN 6

int main() {
  int on = 0;
  low(FAN);
  dht22_set_timeout_ignore(SENSOR, 1);
  while (1) {
    if (dht22_read(SENSOR)) {
      int humid = dht22_getHumidity();
      if (!on && humid > 700) { high(FAN); on = 1; }
      if (on && humid < 600) { low(FAN); on = 0; }
    }
    pause(100);
  }
}
