/* avr-libc 2.0, util/crc16.h: names and signatures. */
#pragma once
#include <stdint.h>
uint16_t _crc16_update(uint16_t crc, uint8_t data);
uint16_t _crc_xmodem_update(uint16_t crc, uint8_t data);
uint16_t _crc_ccitt_update(uint16_t crc, uint8_t data);
uint8_t _crc_ibutton_update(uint8_t crc, uint8_t data);
uint8_t _crc8_ccitt_update(uint8_t crc, uint8_t data);
