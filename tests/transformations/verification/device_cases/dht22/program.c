/* Temperature and humidity, in tenths. */
#include "simpletools.h"
#include "dht22.h"

int main() {
  while (1) {
    if (dht22_read(5)) print("%d %d\n", dht22_getTemp(CELSIUS), dht22_getHumidity());
    pause(2500);
  }
}
