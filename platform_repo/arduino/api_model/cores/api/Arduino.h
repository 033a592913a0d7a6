// A model of the Arduino API, for programs that run on this machine: what ArduinoCore-API declares and all cores have, with its values.
// The board's pins and names come from its data (`API_...`, made by RoboSMi). What is not here is unknown to the model.
#pragma once
#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "avr/pgmspace.h"

#ifdef __cplusplus
extern "C" {
#endif

char *strupr(char *text);  // of newlib, which the cores have, and not of this machine's C library
char *strlwr(char *text);

typedef enum { LOW = 0, HIGH = 1, CHANGE = 2, FALLING = 3, RISING = 4 } PinStatus;
typedef enum { INPUT = 0, OUTPUT = 1, INPUT_PULLUP = 2, INPUT_PULLDOWN = 3 } PinMode;
typedef enum { LSBFIRST = 0, MSBFIRST = 1 } BitOrder;
typedef bool boolean;
typedef uint8_t byte;
typedef uint16_t word;
typedef uint8_t pin_size_t;
typedef void (*voidFuncPtr)(void);
typedef void (*voidFuncPtrParam)(void *);

#define PI 3.1415926535897932384626433832795
#define HALF_PI 1.5707963267948966192313216916398
#define TWO_PI 6.283185307179586476925286766559
#define DEG_TO_RAD 0.017453292519943295769236907684886
#define RAD_TO_DEG 57.295779513082320876798154814105

#define constrain(value, low, high) ((value) < (low) ? (low) : ((value) > (high) ? (high) : (value)))
#define radians(degrees) ((degrees) * DEG_TO_RAD)
#define degrees(radians) ((radians) * RAD_TO_DEG)
#define sq(value) ((value) * (value))
#define lowByte(value) ((uint8_t)((value) & 0xff))
#define highByte(value) ((uint8_t)((value) >> 8))
#define bitRead(value, place) (((value) >> (place)) & 0x01)
#define bitSet(value, place) ((value) |= (1UL << (place)))
#define bitClear(value, place) ((value) &= ~(1UL << (place)))
#define bitToggle(value, place) ((value) ^= (1UL << (place)))
#define bitWrite(value, place, one) ((one) ? bitSet(value, place) : bitClear(value, place))
#define bit(place) (1UL << (place))
#define _BV(place) (1UL << (place))
#define digitalPinToInterrupt(pin) (pin)
#define digitalPinIsValid(pin) apiPinExists(pin)
#define NOT_AN_INTERRUPT (-1)

bool apiPinExists(int pin);
void setup(void);
void loop(void);
void yield(void);
void pinMode(pin_size_t pin, PinMode mode);
void digitalWrite(pin_size_t pin, PinStatus value);
PinStatus digitalRead(pin_size_t pin);
int analogRead(pin_size_t pin);
void analogWrite(pin_size_t pin, int value);
void analogReadResolution(int bits);
void analogWriteResolution(int bits);
unsigned long millis(void);
unsigned long micros(void);
void delay(unsigned long milliseconds);
void delayMicroseconds(unsigned int microseconds);
void shiftOut(pin_size_t data, pin_size_t clock, BitOrder order, uint8_t value);
uint8_t shiftIn(pin_size_t data, pin_size_t clock, BitOrder order);
void attachInterrupt(pin_size_t pin, voidFuncPtr handler, PinStatus mode);
void detachInterrupt(pin_size_t pin);
void interrupts(void);
void noInterrupts(void);

#ifdef __cplusplus
}
#include "Print.h"
#include "Printable.h"
#include "Stream.h"
#include "WCharacter.h"
#include "WString.h"

// Values that programs keep in numbers, which newer versions of the API take
inline void pinMode(pin_size_t pin, int mode) { pinMode(pin, (PinMode)mode); }
inline void digitalWrite(pin_size_t pin, int value) { digitalWrite(pin, value ? HIGH : LOW); }
inline void attachInterrupt(pin_size_t pin, voidFuncPtr handler, int mode) { attachInterrupt(pin, handler, (PinStatus)mode); }
inline void shiftOut(pin_size_t data, pin_size_t clock, int order, uint8_t value) { shiftOut(data, clock, (BitOrder)order, value); }
inline long map(long value, long from, long to, long newFrom, long newTo) {
  return (value - from) * (newTo - newFrom) / (to - from) + newFrom;
}
inline long abs(long value) { return value < 0 ? -value : value; }
inline float abs(float value) { return fabsf(value); }
inline double abs(double value) { return fabs(value); }
template <class T, class L> auto min(const T &a, const L &b) -> decltype(b < a ? b : a) { return b < a ? b : a; }
template <class T, class L> auto max(const T &a, const L &b) -> decltype(b < a ? b : a) { return a < b ? b : a; }
void tone(uint8_t pin, unsigned int frequency, unsigned long duration = 0);
void noTone(uint8_t pin);
unsigned long pulseIn(uint8_t pin, uint8_t state, unsigned long timeout = 1000000UL);
inline unsigned long pulseInLong(uint8_t pin, uint8_t state, unsigned long timeout = 1000000UL) { return pulseIn(pin, state, timeout); }
void randomSeed(unsigned long seed);
long random(long below);
long random(long from, long below);
uint16_t makeWord(uint16_t word);
uint16_t makeWord(uint8_t high, uint8_t low);
#define word(...) makeWord(__VA_ARGS__)

#if defined(ARDUINO_ARCH_ESP32)  // tasks of FreeRTOS, with ticks of 1 ms
void xTaskCreatePinnedToCore(void (*task)(void *), const char *name, uint32_t stack, void *argument, unsigned priority, void **handle, int core);
void vTaskDelay(uint32_t ticks);
inline int xPortGetCoreID() { return 1; }
#endif

#include "HardwareSerial.h"

// The board's first serial port, which is the console
class SerialPort : public HardwareSerial {
 public:
  void begin(unsigned long baud) override;
  void begin(unsigned long baud, uint16_t) override { begin(baud); }
  void end() override {}
  operator bool() override { return true; }
  int available() override { return peek() >= 0; }
  int read() override;
  int peek() override;
  size_t write(uint8_t byte) override;
  using Print::write;
  int availableForWrite() override { return 64; }
  void flush() override;

 private:
  int next = -1;
  uint32_t byteTime = 0;  // us; 0 on USB
  uint64_t lineIsFree = 0;
};
extern SerialPort Serial;
#endif

// The names of the board's pins, as its core has them
enum {
#define API_NAME(name, number) name = number,
  API_NAMES
#undef API_NAME
  NUM_DIGITAL_PINS = API_PIN_COUNT
};
#ifdef API_LED
#define LED_BUILTIN API_LED
#endif

#include "stdlib_noniso.h"
