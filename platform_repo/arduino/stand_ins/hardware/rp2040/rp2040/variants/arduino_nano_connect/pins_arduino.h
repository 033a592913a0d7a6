// Pins of the board, as arduino-pico's variant arduino_nano_connect has them.
#pragma once
#include <stdint.h>

#define OWN_PIN_NUMBERS
static const uint8_t D0 = 1, D1 = 0, D2 = 25, D3 = 15, D4 = 16, D5 = 17, D6 = 18, D7 = 19, D8 = 20, D9 = 21, D10 = 5, D11 = 7, D12 = 4, D13 = 6,
                     D14 = 26, D15 = 27, D16 = 28, D17 = 29, D18 = 12, D19 = 13, A0 = 26, A1 = 27, A2 = 28, A3 = 29;

#define PINS_COUNT 30
#define NUM_DIGITAL_PINS 30
#define NUM_ANALOG_INPUTS 4
#define LED_BUILTIN 6
#define PIN_LED 6
#define PIN_SERIAL1_TX 0
#define PIN_SERIAL1_RX 1
#define PIN_SERIAL2_TX 8
#define PIN_SERIAL2_RX 9
#define PIN_WIRE0_SDA 12
#define PIN_WIRE0_SCL 13
#define PIN_WIRE1_SDA 26
#define PIN_WIRE1_SCL 27
#define PIN_SPI0_MISO 4
#define PIN_SPI0_MOSI 7
#define PIN_SPI0_SCK 6
#define PIN_SPI0_SS 5

#include "../generic/common.h"
