// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

struct text_t {};  // TODO: complete symbol

typedef text_t fdserial;

// fdserial *fdserial_open(int rxpin, int txpin, int mode, int baudrate)  [fdserial.h]
// called in line 4
// it starts code on another core there
inline fdserial *fdserial_open(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  // TODO: complete method
  (void)rxpin;
  (void)txpin;
  (void)mode;
  (void)baudrate;
  return 0;
}

// int fdserial_rxReady(fdserial *term)  [fdserial.h]
// called in line 5
inline int32_t fdserial_rxReady(fdserial *term) {
  // TODO: complete method
  (void)term;
  return 0;
}

// int fdserial_txChar(fdserial *term, int txbyte)  [fdserial.h]
// called in line 3
inline int32_t fdserial_txChar(fdserial *term, int32_t txbyte) {
  // TODO: complete method
  (void)term;
  (void)txbyte;
  return 0;
}
