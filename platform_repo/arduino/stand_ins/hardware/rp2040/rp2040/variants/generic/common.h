// What all boards of the chip share: pins are called by their numbers.
#pragma once
static const uint8_t SDA = PIN_WIRE0_SDA, SCL = PIN_WIRE0_SCL, SS = PIN_SPI0_SS, MOSI = PIN_SPI0_MOSI, MISO = PIN_SPI0_MISO,
                     SCK = PIN_SPI0_SCK;
#ifndef OWN_PIN_NUMBERS
static const uint8_t D0 = 0, D1 = 1, D2 = 2, D3 = 3, D4 = 4, D5 = 5, D6 = 6, D7 = 7, D8 = 8, D9 = 9, D10 = 10, D11 = 11, D12 = 12, D13 = 13,
                     D14 = 14, D15 = 15, D16 = 16, D17 = 17, D18 = 18, D19 = 19, D20 = 20, D21 = 21, D22 = 22, D23 = 23, D24 = 24, D25 = 25,
                     D26 = 26, D27 = 27, D28 = 28, D29 = 29, A0 = 26, A1 = 27, A2 = 28, A3 = 29;
#endif
