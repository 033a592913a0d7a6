// Stand-in for the Arduino core of the RP2040: own code without an SDK, enough to compile and simulate sketches.
// Names and defaults as in arduino-pico: analogRead has 10 bits, analogWrite 8 bits at 1 kHz.
#pragma once
#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/Common.h"
#include "avr/pgmspace.h"
#include "binary.h"

#ifdef __cplusplus
#include <initializer_list>

#include "Print.h"
#include "Printable.h"
#include "Stream.h"
#include "WCharacter.h"
#include "WString.h"

template <class T, class L> auto min(const T &a, const L &b) -> decltype(b < a ? b : a) { return b < a ? b : a; }
template <class T, class L> auto max(const T &a, const L &b) -> decltype(b < a ? b : a) { return a < b ? b : a; }

void tone(uint8_t pin, unsigned int frequency, unsigned long duration = 0);
void noTone(uint8_t pin);
unsigned long pulseIn(uint8_t pin, uint8_t state, unsigned long timeout = 1000000UL);
unsigned long pulseInLong(uint8_t pin, uint8_t state, unsigned long timeout = 1000000UL);
void randomSeed(unsigned long seed);
long random(long below);
long random(long from, long below);
void attachInterrupt(uint8_t pin, void (*handler)(void *), PinStatus mode, void *argument);
uint16_t makeWord(uint16_t word);
uint16_t makeWord(uint8_t high, uint8_t low);
#define word(...) makeWord(__VA_ARGS__)

#include "HardwareSerial.h"
#include "SerialPorts.h"
#endif

#include "pins_arduino.h"
#include "stdlib_noniso.h"
