//# header dht22.h
// Humidity and temperature by one wire. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libdht22 (dht22.h, dht22.c).

//# constant CELSIUS
//#   fidelity: exact
#define CELSIUS 0

//# constant FAHRENHEIT
//#   fidelity: exact
#define FAHRENHEIT 1

//# constant KELVIN
//#   fidelity: exact
#define KELVIN 2

//# helper dht22_celsius
//#   ram: 4
static int32_t dht22_celsius;  // tenths

//# helper dht22_humidity
//#   ram: 4
static int32_t dht22_humidity;  // tenths

//# helper dht22_hasty
//#   ram: 4
static uint32_t dht22_hasty;  // bit for each pin that is read without a pause

//# adapter dht22_set_timeout_ignore
//#   for: void dht22_set_timeout_ignore(int dht_pin, char ignore_timeout)
//#   kind: oneToOne
//#   needs: dht22_hasty
//#   pin: dht_pin digital both
//#   fidelity: exact
//#   stack: 0
inline void dht22_set_timeout_ignore(int32_t dht_pin, char ignore_timeout) {
  uint32_t bit = 1UL << (dht_pin & 31);
  if (ignore_timeout) dht22_hasty |= bit;
  else dht22_hasty &= ~bit;
}

//# adapter dht22_read
//#   for: char dht22_read(int dht_pin)
//#   kind: semantic
//#   needs: dht22_celsius dht22_humidity dht22_hasty hal/Io simpletools.h/TimedInput
//#   pin: dht_pin digital both
//#   fidelity: 1 when the checksum is right, which it never is below 0 degrees, as there; waits for half a second after the last reading, and listens for 47 ms, as there
//#   fidelity: an edge within an interrupt is taken for its middle, and one that an interrupt hides is known by the period: bits are right beside interrupts of up to 40 us
//#   limit: other cogs wait for 6 ms
//#   ram: 128
//#   stack: 42 22
inline char dht22_read(int32_t dht_pin) {
  static uint32_t last[32];
  Io io(dht_pin);
  if (!io.wired() || dht_pin > 31) return 0;
  while (last[dht_pin] && millis() - last[dht_pin] < 500 && !(dht22_hasty >> dht_pin & 1)) yield();
  io.set(false);
  io.drive(true);
  delayMicroseconds(9100);
  delayMicroseconds(9100);
  io.drive(false);
  uint8_t bytes[5] = {0, 0, 0, 0, 0};
  uint32_t begun = micros(), looked = begun, before = 0;
  {
    TimedInput timed;
    uint8_t edges = 0;
    for (bool low = false; looked - begun < 6500 && edges < 42;) {  // from one rising edge to the next: 76 us for 0, 120 us for 1
      bool high = io.high();
      uint32_t now = micros();
      if (low && high) {
        uint32_t edge = looked + (now - looked) / 2;  // an interrupt may lie between two looks
        uint32_t period = edge - before;
        before = edge;
        for (bool hidden = edges >= 2 && edges < 41 && period > 136;; hidden = false, period = 76) {  // two: an interrupt hid a 0's edge
          if (edges >= 2) bytes[(edges - 2) >> 3] = bytes[(edges - 2) >> 3] << 1 | (period > (hidden ? 174 : 98));
          edges++;
          if (!hidden) break;
        }
      }
      looked = now;
      low = !high;
    }
  }
  dht22_humidity = (uint16_t)(bytes[0] << 8 | bytes[1]);
  dht22_celsius = (uint16_t)(bytes[2] << 8 | bytes[3]) & 0x7FFF;
  if (bytes[2] & 0x80) dht22_celsius = -dht22_celsius;
  while (micros() - begun < 47000) yield();
  last[dht_pin] = millis();
  uint8_t sum = bytes[0] + bytes[1] + (uint8_t)(dht22_celsius >> 8) + (uint8_t)dht22_celsius;
  return sum == bytes[4];
}

//# adapter dht22_getTemp
//#   for: int dht22_getTemp(char temp_units)
//#   kind: oneToOne
//#   needs: dht22_celsius KELVIN FAHRENHEIT
//#   fidelity: exact: tenths of a degree
//#   stack: 0
inline int32_t dht22_getTemp(char temp_units) {
  if (temp_units == KELVIN) return dht22_celsius + 2732;
  return temp_units == FAHRENHEIT ? dht22_celsius * 9 / 5 + 320 : dht22_celsius;
}

//# adapter dht22_getHumidity
//#   for: int dht22_getHumidity()
//#   kind: oneToOne
//#   needs: dht22_humidity
//#   fidelity: exact: tenths of a percent
//#   stack: 0
inline int32_t dht22_getHumidity() {
  return dht22_humidity;
}
