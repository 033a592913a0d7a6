/* Temperature, pressure and humidity of the air in several units. */
#include "simpletools.h"
#include "bme680.h"

int main() {
  bme680 *sensor = bme680_openSPI(3, 4, 5, 6);
  bme680_readSensor(sensor);
  print("%.1f C, %.1f F, %.1f K\n", bme680_temperature(sensor, CELSIUS), bme680_temperature(sensor, FAHRENHEIT), bme680_temperature(sensor, KELVIN));
  print("%.0f Pa %.0f %%\n", bme680_pressure(sensor, PASCALS), bme680_humidity(sensor));
  bme680_close(sensor);
}
