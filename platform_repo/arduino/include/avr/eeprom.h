/* avr-libc 2.0, avr/eeprom.h: names and signatures. */
#pragma once
#include <stddef.h>
#include <stdint.h>
#define EEMEM
#define eeprom_is_ready() (1)
#define eeprom_busy_wait() ((void)0)
#ifdef __cplusplus
extern "C" {
#endif
uint8_t eeprom_read_byte(const uint8_t *address);
void eeprom_write_byte(uint8_t *address, uint8_t value);
void eeprom_update_byte(uint8_t *address, uint8_t value);
uint16_t eeprom_read_word(const uint16_t *address);
void eeprom_write_word(uint16_t *address, uint16_t value);
void eeprom_update_word(uint16_t *address, uint16_t value);
uint32_t eeprom_read_dword(const uint32_t *address);
void eeprom_write_dword(uint32_t *address, uint32_t value);
void eeprom_update_dword(uint32_t *address, uint32_t value);
float eeprom_read_float(const float *address);
void eeprom_write_float(float *address, float value);
void eeprom_update_float(float *address, float value);
void eeprom_read_block(void *dst, const void *src, size_t n);
void eeprom_write_block(const void *src, void *dst, size_t n);
void eeprom_update_block(const void *src, void *dst, size_t n);
#ifdef __cplusplus
}
#endif
