/* serial.h of the Simple Libraries: half-duplex serial lines without a buffer. */
#ifndef ROBOSMI_SERIAL_H
#define ROBOSMI_SERIAL_H
#include "simpletext.h"
#define SERIAL_MIN_PIN 0
#define SERIAL_MAX_PIN 31
typedef struct serial_info { int rx_pin, tx_pin, mode, baud, ticks; } Serial_t;
typedef text_t serial;
serial *serial_open(int rxpin, int txpin, int mode, int baudrate);
void serial_close(serial *device);
int serial_rxChar(serial *device);
int serial_txChar(serial *device, int txbyte);
#endif
