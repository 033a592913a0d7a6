// The C part of the Arduino API. Values of the constants as in ArduinoCore-API, which differ from those of the AVR core.
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { LOW = 0, HIGH = 1, CHANGE = 2, FALLING = 3, RISING = 4 } PinStatus;
typedef enum {
  INPUT = 0, OUTPUT = 1, INPUT_PULLUP = 2, INPUT_PULLDOWN = 3, OUTPUT_2MA = 4, OUTPUT_4MA = 5, OUTPUT_8MA = 6, OUTPUT_12MA = 7
} PinMode;
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
#define EULER 2.718281828459045235360287471352
#define SERIAL 0x0
#define DISPLAY 0x1

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
#define digitalPinToPort(pin) (0)
#define digitalPinToBitMask(pin) (1UL << (pin))
#define portOutputRegister(port) ((volatile uint32_t *)0xd0000010)
#define portInputRegister(port) ((volatile uint32_t *)0xd0000004)
#define portModeRegister(port) ((volatile uint32_t *)0xd0000020)
#define NOT_A_PIN (-1)
#define NOT_A_PORT (-1)
#define NOT_AN_INTERRUPT (-1)
#define clockCyclesPerMicrosecond() (F_CPU / 1000000L)
#define clockCyclesToMicroseconds(cycles) ((cycles) / clockCyclesPerMicrosecond())
#define microsecondsToClockCycles(us) ((us) * clockCyclesPerMicrosecond())

void setup(void);
void loop(void);
void yield(void);
void initVariant(void);
void __start_time(void);
void __start_usb(void);
void pinMode(pin_size_t pin, PinMode mode);
void digitalWrite(pin_size_t pin, PinStatus value);
PinStatus digitalRead(pin_size_t pin);
int analogRead(pin_size_t pin);
void analogWrite(pin_size_t pin, int value);
void analogReadResolution(int bits);
void analogWriteResolution(int bits);
void analogWriteRange(uint32_t range);
void analogWriteFreq(uint32_t hertz);
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
// Values that programs keep in numbers: the AVR core takes those, and newer versions of the API do.
inline void pinMode(pin_size_t pin, int mode) { pinMode(pin, (PinMode)mode); }
inline void digitalWrite(pin_size_t pin, int value) { digitalWrite(pin, value ? HIGH : LOW); }
inline void attachInterrupt(pin_size_t pin, voidFuncPtr handler, int mode) { attachInterrupt(pin, handler, (PinStatus)mode); }
inline void shiftOut(pin_size_t data, pin_size_t clock, int order, uint8_t value) { shiftOut(data, clock, (BitOrder)order, value); }
inline long map(long value, long from, long to, long newFrom, long newTo) {
  return (value - from) * (newTo - newFrom) / (to - from) + newFrom;
}
#endif
