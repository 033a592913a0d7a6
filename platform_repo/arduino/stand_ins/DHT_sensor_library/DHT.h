// Stand-in with the API of Adafruit's "DHT sensor library" 1.4. Own code, after the sensors' data sheets.
#ifndef DHT_H
#define DHT_H

#include <Arduino.h>

static const uint8_t DHT11 = 11;
static const uint8_t DHT12 = 12;
static const uint8_t DHT21 = 21;
static const uint8_t DHT22 = 22;
static const uint8_t AM2301 = 21;

class DHT {
 public:
  DHT(uint8_t pin, uint8_t type, uint8_t count = 6);  // count: for compatibility, not used
  void begin(uint8_t usec = 55);                      // usec: how long the line is left to rise after the start signal
  bool read(bool force = false);                      // asks the sensor; within 2 s of the last time only if forced
  float readTemperature(bool S = false, bool force = false);  // Celsius, Fahrenheit if S; NAN if the sensor does not answer
  float readHumidity(bool force = false);                     // percent; NAN if the sensor does not answer
  float convertCtoF(float c);
  float convertFtoC(float f);
  float computeHeatIndex(bool isFahrenheit = true);
  float computeHeatIndex(float temperature, float percentHumidity, bool isFahrenheit = true);

 private:
  bool ask();
  bool waitWhile(uint8_t level);

  uint8_t data[5];
  uint8_t pin;
  uint8_t type;
  uint8_t riseTime;        // microseconds
  bool lastGood;
  unsigned long lastRead;  // milliseconds
};

#endif
