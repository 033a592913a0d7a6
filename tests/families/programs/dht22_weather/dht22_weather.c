/* Temperature and humidity, in each unit, and a reading that comes too soon. */
#include "simpletools.h"
#include "dht22.h"

int main() {
  for (int n = 0; n < 2; n++) {
    int good = dht22_read(9);
    print("%d %d %d %d %d\n", good, dht22_getTemp(CELSIUS), dht22_getTemp(FAHRENHEIT), dht22_getTemp(KELVIN), dht22_getHumidity());
  }
  pause(300);
  dht22_read(9);
  print("%.1f C, %.1f %%\n", dht22_getTemp(CELSIUS) / 10.0, dht22_getHumidity() / 10.0);
}
