/* avr-libc 2.0, avr/io.h: the registers of the microcontroller that the board has; without one, those of the ATmega328P. */
#pragma once
#include <stdint.h>
#define _BV(bit) (1 << (bit))
#define bit_is_set(sfr, bit) ((sfr) & _BV(bit))
#define bit_is_clear(sfr, bit) (!((sfr) & _BV(bit)))
#define loop_until_bit_is_set(sfr, bit) do { } while (bit_is_clear(sfr, bit))
#define loop_until_bit_is_clear(sfr, bit) do { } while (bit_is_set(sfr, bit))
#if defined(__AVR_ATmega2560__)
#include <avr/iom2560.h>
#elif defined(__AVR_ATmega32U4__)
#include <avr/iom32u4.h>
#else
#include <avr/iom328p.h>
#endif
