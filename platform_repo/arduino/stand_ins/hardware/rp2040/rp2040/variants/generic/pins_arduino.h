// Pins of a board that is not known here: numbers are those of the microcontroller, buses where a Pico has them.
#pragma once
#include <stdint.h>

#define PINS_COUNT 30
#define NUM_DIGITAL_PINS 30
#define NUM_ANALOG_INPUTS 4
#define LED_BUILTIN 25
#define PIN_LED 25
#define PIN_SERIAL1_TX 0
#define PIN_SERIAL1_RX 1
#define PIN_SERIAL2_TX 8
#define PIN_SERIAL2_RX 9
#define PIN_WIRE0_SDA 4
#define PIN_WIRE0_SCL 5
#define PIN_WIRE1_SDA 26
#define PIN_WIRE1_SCL 27
#define PIN_SPI0_MISO 16
#define PIN_SPI0_MOSI 19
#define PIN_SPI0_SCK 18
#define PIN_SPI0_SS 17

#include "common.h"
