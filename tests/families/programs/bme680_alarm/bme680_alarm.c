/* A lamp while the air is damp, by a sensor on the same four wires. */
#include "simpletools.h"
#include "bme680.h"

int main() {
  bme680 *s = bme680_openSPI(9, 8, 7, 6);
  for (int n = 0; n < 2; n++) {
    bme680_readSensor(s);
    int damp = bme680_humidity(s) > 60.0;
    set_direction(26, 1);
    set_output(26, damp);
    print("%d %.1f %.1f\n", damp, bme680_temperature(s, CELSIUS), bme680_pressure(s, MMHG));
    pause(700);
  }
}
