/* Included as bus/wire.h; includes board.h back, and a header that is not here. */
#ifndef WIRE_H
#define WIRE_H
#include "board.h"
#include <vendor/secret.h>
#ifndef BOARD_PINS
#define BOARD_PINS 20
#endif
typedef struct wire *wire_t;
wire_t wire_open(int sda, int scl, wire_mode mode);
int wire_write(wire_t wire, const uint8_t *data, int length);
#endif
