// The protocol (data sheets of DHT11 and DHT22/AM2302): the controller holds the line low for 18 ms (DHT22: 1 ms) and lets it
// go; the sensor answers 80 us low, 80 us high, and 40 bits, each 50 us low and then high for 26 to 28 us (0) or 70 us (1).
// Four bytes of values, the fifth is the low byte of their sum.
#include "DHT.h"

namespace {

const unsigned long SHORTEST_PAUSE = 2000;  // milliseconds between two readings
const uint8_t BIT_SAMPLE = 40;              // microseconds after the rise, a 0 is over and a 1 is not
const uint16_t GIVE_UP = 400;               // looks at the line without a change, about a millisecond at 16 MHz

}  // namespace

DHT::DHT(uint8_t pin, uint8_t type, uint8_t count)
    : data(), pin(pin), type(type), riseTime(55), lastGood(false), lastRead(0) {
  (void)count;
}

void DHT::begin(uint8_t usec) {
  pinMode(pin, INPUT_PULLUP);
  riseTime = usec;
  lastRead = millis() - SHORTEST_PAUSE;
}

bool DHT::waitWhile(uint8_t level) {
  for (uint16_t looks = 0; looks < GIVE_UP; looks++) {
    if (digitalRead(pin) != level) return true;
  }
  return false;
}

bool DHT::read(bool force) {
  const unsigned long now = millis();
  if (!force && now - lastRead < SHORTEST_PAUSE) return lastGood;
  lastRead = now;
  lastGood = ask();
  return lastGood;
}

bool DHT::ask() {
  for (uint8_t i = 0; i < 5; i++) data[i] = 0;
  pinMode(pin, INPUT_PULLUP);
  delay(1);
  pinMode(pin, OUTPUT);
  digitalWrite(pin, LOW);
  if (type == DHT22 || type == DHT21) {
    delayMicroseconds(1100);
  } else {
    delay(20);
  }

  const uint8_t status = SREG;
  pinMode(pin, INPUT_PULLUP);
  delayMicroseconds(riseTime);
  cli();
  bool good = waitWhile(HIGH) && waitWhile(LOW) && waitWhile(HIGH);
  for (uint8_t bit = 0; good && bit < 40; bit++) {
    good = waitWhile(LOW);
    delayMicroseconds(BIT_SAMPLE);
    const bool one = digitalRead(pin) == HIGH;
    data[bit / 8] = static_cast<uint8_t>(data[bit / 8] << 1 | (one ? 1 : 0));
    if (one) good = good && waitWhile(HIGH);
  }
  SREG = status;
  return good && data[4] == static_cast<uint8_t>(data[0] + data[1] + data[2] + data[3]);
}

float DHT::readTemperature(bool S, bool force) {
  if (!read(force)) return NAN;
  float celsius;
  if (type == DHT22 || type == DHT21) {
    celsius = (static_cast<uint16_t>(data[2] & 0x7F) << 8 | data[3]) * 0.1f;
    if (data[2] & 0x80) celsius = -celsius;
  } else if (type == DHT12) {
    celsius = data[2] + (data[3] & 0x7F) * 0.1f;
    if (data[3] & 0x80) celsius = -celsius;
  } else {
    celsius = data[2];
    if (data[3] & 0x80) celsius = -1 - celsius;
    celsius += (data[3] & 0x0F) * 0.1f;
  }
  return S ? convertCtoF(celsius) : celsius;
}

float DHT::readHumidity(bool force) {
  if (!read(force)) return NAN;
  if (type == DHT22 || type == DHT21) return (static_cast<uint16_t>(data[0]) << 8 | data[1]) * 0.1f;
  return data[0] + data[1] * 0.1f;
}

float DHT::convertCtoF(float c) { return c * 1.8f + 32; }

float DHT::convertFtoC(float f) { return (f - 32) / 1.8f; }

float DHT::computeHeatIndex(bool isFahrenheit) {
  return computeHeatIndex(readTemperature(isFahrenheit), readHumidity(), isFahrenheit);
}

// US National Weather Service: the mean of temperature and Steadman's simple formula, from about 80 F on Rothfusz's regression
// with its adjustments.
float DHT::computeHeatIndex(float temperature, float percentHumidity, bool isFahrenheit) {
  const float t = isFahrenheit ? temperature : convertCtoF(temperature);
  const float h = percentHumidity;
  float index = 0.5f * (t + 61 + (t - 68) * 1.2f + h * 0.094f);
  if (index > 79) {
    index = -42.379f + 2.04901523f * t + 10.14333127f * h - 0.22475541f * t * h - 0.00683783f * t * t -
            0.05481717f * h * h + 0.00122874f * t * t * h + 0.00085282f * t * h * h - 0.00000199f * t * t * h * h;
    if (h < 13 && t >= 80 && t <= 112) {
      index -= (13 - h) * 0.25f * sqrt((17 - fabs(t - 95)) / 17);
    } else if (h > 85 && t >= 80 && t <= 87) {
      index += (h - 85) * 0.1f * ((87 - t) * 0.2f);
    }
  }
  return isFahrenheit ? index : convertFtoC(index);
}
