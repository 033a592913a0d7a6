/* dht22.h of the Simple Libraries: a humidity and temperature sensor on one wire. */
#ifndef ROBOSMI_DHT22_H
#define ROBOSMI_DHT22_H
#ifndef CELSIUS
#define CELSIUS 0
#endif
#ifndef FAHRENHEIT
#define FAHRENHEIT 1
#endif
#ifndef KELVIN
#define KELVIN 2
#endif
char dht22_read(int dht_pin);
void dht22_set_timeout_ignore(int dht_pin, char ignore_timeout);
int dht22_getTemp(char temp_units);
int dht22_getHumidity();
#endif
