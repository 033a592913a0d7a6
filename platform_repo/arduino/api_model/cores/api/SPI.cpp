#include "SPI.h"

#include "../../chip/board.h"
#include "pins.h"

SPIClass SPI;

#if defined(API_SCK) && defined(API_MOSI) && defined(API_MISO)
void SPIClass::begin() {
  digitalWrite(API_SCK, current.mode & 2 ? HIGH : LOW);
  pinMode(API_SCK, OUTPUT);
  pinMode(API_MOSI, OUTPUT);
  pinMode(API_MISO, INPUT);
}

uint8_t SPIClass::transfer(uint8_t byte) {
  bool rest = current.mode & 2, late = current.mode & 1;  // of the clock; whether data is taken at its second edge
  uint8_t answer = 0;
  for (int place = 0; place < 8; place++) {
    int bit = current.order == LSBFIRST ? place : 7 - place;
    if (late) digitalWrite(API_SCK, rest ? LOW : HIGH);
    digitalWrite(API_MOSI, byte >> bit & 1 ? HIGH : LOW);
    digitalWrite(API_SCK, rest == late ? HIGH : LOW);
    answer |= digitalRead(API_MISO) << bit;
    if (!late) digitalWrite(API_SCK, rest ? HIGH : LOW);
  }
  return answer;
}
#else
void SPIClass::begin() { board_lacks("SPI on this board"); }
uint8_t SPIClass::transfer(uint8_t) { return 0; }
#endif
