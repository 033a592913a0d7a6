// Adapters for what the program uses of propeller: each has the signature it had there, with the widths it had
// there, and a body that is still to be written for Arduino Uno.
#pragma once

#include <Arduino.h>

struct text_t {};  // TODO: complete symbol

typedef text_t fdserial;

struct i2c {};  // TODO: complete symbol

typedef text_t serial;

// fdserial *fdserial_open(int rxpin, int txpin, int mode, int baudrate)  [fdserial.h]
// called in line 9
// it starts code on another core there
fdserial *fdserial_open(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  // TODO: complete method
  (void)rxpin;
  (void)txpin;
  (void)mode;
  (void)baudrate;
  return 0;
}

// int fdserial_rxChar(fdserial *term)  [fdserial.h]
// called in line 14
// it blocks
int32_t fdserial_rxChar(fdserial *term) {
  // TODO: complete method
  (void)term;
  return 0;
}

// int fdserial_txChar(fdserial *term, int txbyte)  [fdserial.h]
// called in line 15
int32_t fdserial_txChar(fdserial *term, int32_t txbyte) {
  // TODO: complete method
  (void)term;
  (void)txbyte;
  return 0;
}

// int i2c_in(i2c *busID, int i2cAddr, int memAddr, int memAddrCount, unsigned char *data, int dataCount)  [simpletools.h]
// called in line 16
int32_t i2c_in(i2c *busID, int32_t i2cAddr, int32_t memAddr, int32_t memAddrCount, unsigned char *data, int32_t dataCount) {
  // TODO: complete method
  (void)busID;
  (void)i2cAddr;
  (void)memAddr;
  (void)memAddrCount;
  (void)data;
  (void)dataCount;
  return 0;
}

// i2c *i2c_newbus(int sclPin, int sdaPin, int sclDrive)  [simpletools.h]
// called in line 12
i2c *i2c_newbus(int32_t sclPin, int32_t sdaPin, int32_t sclDrive) {
  // TODO: complete method
  (void)sclPin;
  (void)sdaPin;
  (void)sclDrive;
  return 0;
}

// serial *serial_open(int rxpin, int txpin, int mode, int baudrate)  [serial.h]
// called in line 11
serial *serial_open(int32_t rxpin, int32_t txpin, int32_t mode, int32_t baudrate) {
  // TODO: complete method
  (void)rxpin;
  (void)txpin;
  (void)mode;
  (void)baudrate;
  return 0;
}
