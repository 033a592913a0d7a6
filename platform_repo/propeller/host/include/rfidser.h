/* rfidser.h of the Simple Libraries: a reader of RFID cards with a serial line. */
#ifndef RFIDSER_H
#define RFIDSER_H
#include "fdserial.h"
typedef text_t rfidser;
rfidser *rfid_open(int soutPin, int enablePin);
void rfidser_close(rfidser *device);
void rfid_reset(rfidser *device);
void rfid_disable(rfidser *device);
void rfid_enable(rfidser *device);
char *rfid_get(rfidser *device, int timeoutms);
#endif
